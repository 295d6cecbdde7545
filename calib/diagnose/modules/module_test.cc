#include "calib/diagnose/modules/module_test.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "calib/diagnose/modules/effect_steps.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kTestSteps = 50;
constexpr double kTestStep = 2e-3;       // s
constexpr double kTestWarmth = 12;       // K
constexpr double kLeastAmplitude = .01;  // of joints that do not move, any unit

// Sines of all joints.
struct Sines {
  VectorXd centre, amplitude, omega, phase;

  double At(int j, double t) const {
    return centre[j] + amplitude[j] * std::sin(omega[j] * t + phase[j]);
  }
  double RateAt(int j, double t) const {
    return amplitude[j] * omega[j] * std::cos(omega[j] * t + phase[j]);
  }
};

Sines DrawSines(const VectorXd& centre, const VectorXd& amplitude,
                std::mt19937_64* random) {
  Sines sines{centre, amplitude.cwiseMax(kLeastAmplitude), centre, centre};
  for (Eigen::Index j = 0; j < centre.size(); ++j) {
    sines.omega[j] = 2 * M_PI * (10 + 15 * UniformDraw(random));  // rad/s
    sines.phase[j] = 2 * M_PI * UniformDraw(random);
  }
  return sines;
}

}  // namespace

double ModuleTest::LargestOf(VectorXd Step::*values) const {
  double largest = 1e-3;
  for (const Step& step : steps) {
    largest = std::max(largest, (step.*values).cwiseAbs().maxCoeff());
  }
  return largest;
}

ModuleTest MakeModuleTest(const CorrectedRobot& robot) {
  std::mt19937_64 random(1);
  const MotionScale& scale = robot.scale;
  const VectorXd zero = VectorXd::Zero(scale.low.size());
  Sines motion = DrawSines((scale.low + scale.high) / 2, scale.speed, &random);
  motion.amplitude = 2 * motion.amplitude.cwiseQuotient(motion.omega);
  const Sines command = DrawSines(zero, 2 * scale.torque, &random);
  const Sines load = DrawSines(zero, 2 * scale.load, &random);
  ModuleTest test{
      kTestStep, scale.begin + 1, zero.array() + kTestWarmth, zero, {}};
  for (int j = 0; j < zero.size(); ++j) test.load[j] = load.At(j, 0);
  EffectSteps steps(robot, test.load);
  steps.SetTime(test.t);
  steps.SetWarmth(test.warmth);
  for (int k = 0; k < kTestSteps; ++k) {
    ModuleTest::Step step{zero, zero, zero, zero, {}, {}, {}, {}};
    const double t = k * kTestStep;
    for (int j = 0; j < zero.size(); ++j) {
      step.q[j] = motion.At(j, t);
      step.qd[j] = motion.RateAt(j, t);
      step.commanded[j] = command.At(j, t);
      step.load[j] = load.At(j, t);
    }
    if (2 * k >= kTestSteps) step.load.resize(0);
    step.reading = steps.Sense(kTestStep, step.q, step.qd);
    step.torque = steps.Act(step.commanded, step.load);
    step.damping = steps.damping();
    step.undamped = steps.undamped();
    test.steps.push_back(step);
  }
  return test;
}

}  // namespace armcal
