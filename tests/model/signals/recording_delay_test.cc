#include "model/signals/recording_delay.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::recording_delay_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .004;   // s
constexpr int kSamples = 2500;   // 10 s
constexpr double kDelay = .006;  // s, by which motors give what was recorded
constexpr double kSlow = 2 * M_PI, kFast = 2 * M_PI * 12;

// Slow and fast, 20 and 1 N m, `late` seconds later than t.
MatrixXd Torque(double late) {
  return VectorXd::NullaryExpr(kSamples, [late](Eigen::Index k) {
    const double t = k * kStep - late;
    return 20 * std::sin(kSlow * t) + std::sin(kFast * t);
  });
}

// Away from the ends, whose filters do not know what comes.
double LargestInside(const MatrixXd& x) {
  return x.middleRows(250, kSamples - 500).cwiseAbs().maxCoeff();
}

// The recording tells its own delay, whatever the model says of what is slow.
TEST(RecordingDelay, OfAWrongModelIsThatOfTheRecording) {
  const MatrixXd given = Torque(kDelay), recorded = Torque(0);
  const MatrixXd model = .9 * given;
  const double change = LargestInside(recorded - given);
  const auto error = [&](const SmoothTorque& smooth) {
    return LargestInside(ChangeByDelay(model, smooth, kStep, -kDelay) -
                         (recorded - given)) /
           change;
  };
  EXPECT_GT(error({}), .09);
  EXPECT_LT(error({recorded, .5 / kStep}), .02);
  // Of what the smooth recording does not have, as wrong as the model.
  const MatrixXd slow = VectorXd::NullaryExpr(kSamples, [](Eigen::Index k) {
    return 20 * std::sin(kSlow * static_cast<double>(k) * kStep);
  });
  EXPECT_LT(error({slow, 4}), .05);
}

TEST(RecordingDelay, SlopeIsThatOfASmallDelay) {
  const MatrixXd given = Torque(0);
  const MatrixXd slope = VectorXd::NullaryExpr(kSamples, [](Eigen::Index k) {
    const double t = static_cast<double>(k) * kStep;
    return -20 * kSlow * std::cos(kSlow * t) - kFast * std::cos(kFast * t);
  });
  const double most = LargestInside(slope);
  EXPECT_LT(LargestInside(SlopeByDelay(given, {}, kStep) - slope), .01 * most);
  const MatrixXd model = .9 * given;
  EXPECT_GT(LargestInside(SlopeByDelay(model, {}, kStep) - slope), .09 * most);
  EXPECT_LT(
      LargestInside(SlopeByDelay(model, {given, .5 / kStep}, kStep) - slope),
      .01 * most);
}

}  // namespace armcal::recording_delay_test
