#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/judge/corrected_draws.h"
#include "calib/diagnose/select/missing_terms.h"
#include "model/robot_files/robot_reader.h"
#include "tests/fixtures/torque_spread.h"

namespace armcal::corrected_draws_long_test {

int Place(const GapFit& fit, const std::string& name) {
  const std::vector<GapCandidate>& effects = fit.refined().effects;
  for (size_t k = 0; k < effects.size(); ++k) {
    if (effects[k].effect->name == name) return static_cast<int>(k);
  }
  ADD_FAILURE() << "no " << name;
  return 0;
}

// A real arm by one log, at the motion of another, which nothing was fitted to.
TEST(CorrectedDrawsOfUr10e, SpreadAsThePosteriorSays) {
  const std::string folder = SHARED_DIR "/data/ur10e_free/";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "no " << folder;
  }
  constexpr double kBandwidth = 10;
  const Robot file = ReadRobot(folder + "robot.urdf", {});
  LogReaderOptions reader;
  reader.joint_names = file.JointNames();
  reader.torque_constants = {14.87, 13.26, 11.13, 10.62, 11.03, 11.47};
  reader.torque_constants_stddev.reset();
  const auto read = [&](const std::string& name) {
    const LogSet logs(LogFiles({folder + name}), reader, {});
    return ReadSegments(kBandwidth, {}, logs);
  };
  const std::vector<GapSegment> segments = read("id_30s.csv");
  BaselineOptions options;
  const MissingTerms missing =
      FitMissingTerms(file, options, kBandwidth, segments);
  for (const MissingTerm& term : missing.terms) {
    options.missing_terms[term.joint_term] = term.usual;
  }
  GapBaseline baseline(missing.robot, options, UsualTorque(segments));
  {
    const GapRows rows(segments, kBandwidth);
    baseline.AddDiscrepancy(Discrepancy(
        file, ScaleOf(baseline, rows, RecordedTorques(baseline, rows)), 1,
        .05));
  }
  GapFitOptions fit_options;
  fit_options.bandwidth_hz = kBandwidth;
  GapFit fit(baseline, fit_options, segments, {});
  fit.Choose();
  fit.KeepOnly({Place(fit, "delay")});  // what is claimed of it
  const CorrectedPosterior posterior = PosteriorOf(fit);
  const CorrectedDraws draws = DrawCorrected(fit, posterior, file, kRobots);
  ExpectPossible(draws);
  const TorqueSpread spread =
      SpreadOf(fit, posterior, draws, read("val_ptp.csv")[0].motion);
  Record(spread);
  EXPECT_NEAR(spread.Whole(), 1, .1);
}

}  // namespace armcal::corrected_draws_long_test
