#include "model/dynamics/actuator_inversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/dynamics/motor_map.h"

namespace armcal::actuator_inversion_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamples = 400;
constexpr double kStep = .01;  // s

MotionTrack Rest() {
  MotionTrack track;
  track.t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
  track.position = track.velocity = track.load = track.warmth =
      MatrixXd::Zero(1, kSamples);
  return track;
}

// Two waves of 1 and 5 Hz, N m, and its slope.
VectorXd Wave(double (*f)(double)) { return Rest().t.unaryExpr(f); }
double Torque(double t) {
  return 8 * std::sin(2 * M_PI * t) + std::sin(31 * t);
}
double Slope(double t) {
  return 16 * M_PI * std::cos(2 * M_PI * t) + 31 * std::cos(31 * t);
}

ActuatorMap Stateless(const std::function<double(double)>& given) {
  return {{},
          [given](const ArmInstant&, const double*, double*, VectorXd* torque) {
            (*torque)[0] = given((*torque)[0]);
          }};
}
ActuatorMap Motor(const std::function<double(double)>& given) {
  return {{}, MotorMap{0, [given](double x, double) { return given(x); }, {}}};
}
ActuatorMap Lag(double time) {
  return {VectorXd::Zero(1), [time](const ArmInstant&, const double* given,
                                    double* rate, VectorXd* torque) {
            rate[0] = ((*torque)[0] - given[0]) / time;
            (*torque)[0] = given[0];
          }};
}

TEST(ActuatorInversion, InvertsMapsWithoutStates) {
  const VectorXd needed = Wave(Torque);
  const VectorXd commanded = CommandFor(
      {Stateless([](double x) { return x / 1.2 - .3; }),
       Stateless([](double x) { return x + .05 * x * std::abs(x); })},
      Rest(), needed, {});
  for (int k = 0; k < kSamples; ++k) {
    // y + 0.05 y |y| = needed, y = commanded / 1.2 - 0.3.
    const double a = std::abs(needed[k]);
    const double y = std::copysign(10 * (std::sqrt(1 + .2 * a) - 1), needed[k]);
    EXPECT_NEAR(commanded[k], 1.2 * (y + .3), 1e-6) << k;
  }
}

// A motor's map that is known as one, and the same that is not.
TEST(ActuatorInversion, InvertsMotorsAsOtherMaps) {
  const auto given = [](double x) {
    return x + .5 * std::sin(x) + .02 * x * std::abs(x);
  };
  const VectorXd needed = Wave(Torque);
  for (const VectorXd& guess : {VectorXd(), VectorXd(needed * .9)}) {
    const ActuatorMap motor = Motor(given);
    const MatrixXd commanded = CommandFor({motor}, Rest(), needed, guess);
    const MatrixXd other =
        CommandFor({Stateless(given)}, Rest(), needed, guess);
    EXPECT_LT((commanded - other).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((commanded.unaryExpr(given) - needed).cwiseAbs().maxCoeff(),
              1e-8);
  }
}

// A limit that falls with the speed along the torque: half of it at 1 rad/s,
// against which it grows.
TEST(ActuatorInversion, AsksOfAMotorWhatItGivesAtItsVelocity) {
  const auto given = [](double x, double v) {
    return (2 - v * std::copysign(1, x)) * std::tanh(x);
  };
  MotionTrack track = Rest();
  track.velocity = Wave([](double t) { return std::sin(3 * t); }).transpose();
  const VectorXd asked = Wave([](double t) { return 1.5 * std::sin(t); });
  VectorXd needed(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    needed[k] = given(asked[k], track.velocity(0, k));
  }
  const VectorXd commanded = CommandFor(
      {ActuatorMap{{}, MotorMap{0, given, {}}}}, track, needed, .95 * asked);
  EXPECT_LT((commanded - asked).cwiseAbs().maxCoeff(), 1e-6);
}

// A map whose inverse is known needs no record.
TEST(ActuatorInversion, TakesTheInverseOfAMotor) {
  const VectorXd needed = Wave(Torque);
  const ActuatorMap motor = {
      {},
      MotorMap{0, [](double x, double) { return std::sinh(x); },
               [](double y) { return std::asinh(y); }}};
  const VectorXd commanded =
      CommandFor({motor}, Rest(), needed, VectorXd::Zero(kSamples));
  for (int k = 0; k < kSamples; ++k) {
    EXPECT_DOUBLE_EQ(commanded[k], std::asinh(needed[k])) << k;
  }
}

// A motor's constant may be a third or three times of what is assumed, and the
// first step, which takes it for right, then leads beyond.
TEST(ActuatorInversion, InvertsSteepMotors) {
  const VectorXd needed = Wave(Torque);
  for (const double slope : {1 / .2, 1 / .3, 1 / .5, 1 / 3.}) {
    const auto given = [slope](double x) { return slope * x; };
    for (const VectorXd& guess : {VectorXd(), VectorXd(needed / 2)}) {
      for (const ActuatorMap& motor : {Motor(given), Stateless(given)}) {
        const VectorXd commanded = CommandFor({motor}, Rest(), needed, guess);
        EXPECT_LT((slope * commanded - needed).cwiseAbs().maxCoeff(), 1e-8)
            << slope;
      }
    }
  }
}

// Where a motor is at its limit only the record says what was asked.
TEST(ActuatorInversion, BelievesTheRecordAtALimit) {
  const auto clip = [](double x) { return std::clamp(x, -5., 5.); };
  const VectorXd asked = Wave(Torque);
  const VectorXd commanded =
      CommandFor({Stateless(clip)}, Rest(), asked.unaryExpr(clip), asked);
  EXPECT_LT((commanded - asked).cwiseAbs().maxCoeff(), 1e-9);
  // What the model says wrongly of the limit is said once.
  const VectorXd wrong_limit = asked.unaryExpr(clip) * 1.02;
  const VectorXd changed =
      CommandFor({Stateless(clip)}, Rest(), wrong_limit, asked) - asked;
  for (int k = 0; k < kSamples; ++k) {
    if (std::abs(asked[k]) > 5) {
      EXPECT_NEAR(changed[k], std::copysign(.1, asked[k]), 1e-9) << k;
    }
  }
  // Elsewhere it is not believed.
  const VectorXd wrong = asked + VectorXd::Ones(kSamples);
  const VectorXd again = CommandFor({Stateless([](double x) { return x / 2; })},
                                    Rest(), asked, wrong);
  EXPECT_LT((again - 2 * asked).cwiseAbs().maxCoeff(), 1e-6);
}

// A lag's input is its output plus its time constant times the slope.
TEST(ActuatorInversion, InvertsALag) {
  for (const double time : {.001, .004, .02}) {
    const VectorXd needed = Wave(Torque), slope = Wave(Slope);
    const VectorXd change =
        CommandFor({Lag(time)}, Rest(), needed, {}) - needed;
    const VectorXd error = (change - time * slope).segment(20, kSamples - 40);
    EXPECT_LT(error.norm(), .04 * time * slope.norm()) << time;
  }
}

TEST(ActuatorInversion, GivenTorqueLags) {
  const VectorXd given = GivenTorque({Lag(.02)}, Rest(), Wave(Torque));
  VectorXd asked(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kStep;
    asked[k] = 0;
    for (const auto& [a, w] : {std::pair(8., 2 * M_PI), std::pair(1., 31.)}) {
      asked[k] += a * (std::sin(w * t) - w * .02 * std::cos(w * t)) /
                  (1 + w * w * .02 * .02);
    }
  }
  EXPECT_LT((given - asked).tail(kSamples - 40).cwiseAbs().maxCoeff(), .02);
}

}  // namespace armcal::actuator_inversion_test
