#include "calib/verify/verification_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace armcal::verification_report_test {

using testing::HasSubstr;
using testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A calibration whose rollouts of 0.5 s have this ratio to the file's.
VerificationReport WithRatio(RolloutFigure ratio) {
  VerificationReport report;
  report.robot.name = "arm";
  report.calibration = "calibration.json";
  report.verification = {0, 0, 0, 0, 0, 0, 0, 1000, 0, 10, {}};
  RolloutComparison c;
  c.window_s = .5;
  c.unit = "rad";
  c.windows = ratio.windows;
  c.before = {.02, .01, .03, ratio.windows, ratio.block};
  c.after = {.02 * ratio.value, .01, .03, ratio.windows, ratio.block};
  c.ratio = ratio;
  c.before_velocity_rms = c.after_velocity_rms = .1;
  report.rollouts.emplace();
  report.rollouts->windows = {c};
  return report;
}

TEST(VerificationReport, BetterIsSaidOfNothingElse) {
  const VerificationReport better = WithRatio({.5, .4, .6, 60, 6});
  EXPECT_TRUE(better.passed());
  EXPECT_THAT(FullReport(better), Not(HasSubstr("joints in rad")));
  const VerificationReport equal = WithRatio({.9, .8, 1.1, 60, 6});
  EXPECT_TRUE(equal.passed());
  EXPECT_THAT(FullReport(equal),
              HasSubstr("rad: not shown to be better than the file\n"));
  const VerificationReport worse = WithRatio({1.5, 1.2, 1.9, 60, 6});
  EXPECT_FALSE(worse.passed());
  EXPECT_THAT(FullReport(worse),
              HasSubstr("rollout_ratio_low_0.5s_rad is 1.2"));
}

TEST(VerificationReport, TooFewWindowsAreNotJudged) {
  const VerificationReport few = WithRatio({1.5, 1.2, 1.9, 59, 6});
  EXPECT_TRUE(few.passed());
  EXPECT_EQ(few.Checks().size(), few.verification.Checks().size());
  EXPECT_THAT(FullReport(few), HasSubstr("rad: too few windows to judge\n"));
  EXPECT_EQ(ToJson(few)["rollout"][0]["judged"], false);
  EXPECT_EQ(ToJson(few)["rollout"][0]["block_windows"], 6);
}

// Several lengths of windows say the same thing several times; one is judged.
TEST(VerificationReport, OneLengthOfWindowsIsJudged) {
  VerificationReport report = WithRatio({1.5, 1.2, 1.9, 60, 6});
  report.rollouts->windows[0].window_s = 1;
  EXPECT_TRUE(report.passed());
  EXPECT_THAT(FullReport(report), Not(HasSubstr("joints in rad")));
}

TEST(VerificationReport, NoWindowIsNoDivergence) {
  VerificationReport report = WithRatio({kNaN, kNaN, kNaN, 0, 1});
  EXPECT_THAT(FullReport(report), HasSubstr("no window"));
  EXPECT_THAT(FullReport(report), Not(HasSubstr("diverges")));
  RolloutComparison& c = report.rollouts->windows[0];
  c.windows = c.before.windows = 4;
  c.before.value = std::numeric_limits<double>::infinity();
  EXPECT_THAT(FullReport(report), HasSubstr("diverges"));
}

// Wide figures stay in their columns.
TEST(VerificationReport, ColumnsHoldWideFigures) {
  VerificationReport report = WithRatio({5.55e-6, 4.44e-6, 6.66e-6, 60, 6});
  RolloutComparison& c = report.rollouts->windows[0];
  c.before = {1.94e3, 1.75e3, 2.06e3, 60, 6};
  c.after = {1.11e-5, 1.01e-5, 1.21e-5, 60, 6};
  const std::string text = FullReport(report);
  const auto column = [&text](const std::string& of) {
    const size_t at = text.find(of);
    return at - text.rfind('\n', at);
  };
  EXPECT_EQ(column("1.94e+03 [1.75e+03 2.06e+03]"), column("the file's robot"));
  EXPECT_EQ(column("1.11e-05 [1.01e-05 1.21e-05]"), column("calibrated  "));
  EXPECT_EQ(column("5.55e-06 [4.44e-06 6.66e-06]"), column("ratio\n"));
}

TEST(VerificationReport, TellsOfACalibrationThatDidNotConverge) {
  VerificationReport report = WithRatio({.5, .4, .6, 60, 6});
  EXPECT_THAT(FullReport(report), Not(HasSubstr("converge")));
  EXPECT_EQ(ToJson(report)["calibration_converged"], true);
  report.calibration_converged = false;
  EXPECT_THAT(FullReport(report),
              HasSubstr("note       the calibration did not converge"));
  EXPECT_EQ(ToJson(report)["calibration_converged"], false);
}

}  // namespace armcal::verification_report_test
