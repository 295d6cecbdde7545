// Postures that tell effects of the geometry apart: what is predicted of them
// is what estimates from noisy poses scatter by.

#include "calib/excite/posture_model.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "calib/excite/posture_design.h"
#include "calib/poses/pose_solution.h"
#include "model/robot/kinematics.h"
#include "model/text/option_error.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::posture_model_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class SeparatingPostures : public ::testing::Test {
 protected:
  SeparatingPostures() : robot_(SampleRobot("UR5 6R")) {
    options_.count = 30;
    options_.lower = VectorXd::Constant(6, -2.5);
    options_.upper = VectorXd::Constant(6, 2.5);
    options_.noise = {1e-4, 1e-4};
    options_.separate = {"sag", "second_harmonic"};
  }
  Robot robot_;
  PostureOptions options_;
};

TEST_F(SeparatingPostures, AreBetterThanRandomOnes) {
  const PostureDesign design = DesignPostures(robot_, options_);
  // Of each joint a sine and a cosine, and sag where weight has a lever.
  EXPECT_GT(design.names.size(), 12u + 2);
  for (const std::string& name : design.names) {
    EXPECT_TRUE(name.rfind("sag", 0) == 0 ||
                name.rfind("second_harmonic", 0) == 0)
        << name;
  }
  EXPECT_LT(design.stddev.norm(), .7 * design.random_stddev.norm());
  // The geometry's own design tells them worse.
  PostureOptions geometry = options_;
  geometry.separate.clear();
  const MatrixXd q = DesignPostures(robot_, geometry).q;
  EXPECT_LT(design.criterion, PostureCriterion(robot_, options_, q));
}

TEST_F(SeparatingPostures, PredictTheScatterOfEstimates) {
  const PostureDesign design = DesignPostures(robot_, options_);
  const Eigen::Vector3d target(.08, .05, .1);
  PoseMeasurements exact;
  exact.q = design.q;
  exact.targets.assign(1, MatrixXd(options_.count, 3));
  for (int k = 0; k < options_.count; ++k) {
    exact.row.push_back(k + 2);
    exact.targets[0].row(k) = ToolPose(robot_, design.q.row(k)) * target;
  }
  std::mt19937_64 random(3);
  std::normal_distribution<double> error(0, 1e-4);
  constexpr int kDraws = 40;
  VectorXd squares = VectorXd::Zero(design.stddev.size());
  for (int draw = 0; draw < kDraws; ++draw) {
    PoseMeasurements noisy = exact;
    for (double& x : noisy.targets[0].reshaped()) x += error(random);
    PoseCalibrationOptions plain;
    plain.loss = RobustLoss::kSquared;
    PoseFit fit(robot_, noisy, plain);
    const PoseSolution solution = SolvePoses(noisy, plain.refine, &fit);
    ASSERT_TRUE(solution.refusal.empty());
    PoseStudy study = {{robot_},
                       noisy,
                       PoseEquations(fit, noisy),
                       std::numeric_limits<double>::infinity()};
    study.equations.SetFree(solution.free);
    const PoseModel alone =
        FitGeometryAlone(study, {solution.unknowns, VectorXd()});
    std::vector<PlacedPoseEffect> effects;
    for (const std::string& name : options_.separate) {
      for (const PoseEffect& effect : PoseEffects()) {
        if (effect.name != name) continue;
        for (const PosePlace& place : effect.places(alone.campaign)) {
          if (place.parts < 2) effects.push_back({&effect, place});
        }
      }
    }
    const PoseModel model = FitPoseModel(study, effects, alone,
                                         VectorXd::Zero(design.stddev.size()));
    squares += model.estimate.state.amounts.cwiseAbs2();
  }
  const VectorXd ratio =
      (squares / kDraws).cwiseSqrt().cwiseQuotient(design.stddev);
  // 40 draws know a standard deviation to 11 %; 1.5 is 4.5 of that.
  EXPECT_LT(ratio.maxCoeff(), 1.5);
  // A compliance, which is 0 here, is no less than that: it scatters by less.
  for (int k = 0; k < ratio.size(); ++k) {
    const bool is_sag = design.names[k].rfind("sag", 0) == 0;
    EXPECT_GT(ratio[k], is_sag ? 0 : .6) << design.names[k];
  }
}

TEST_F(SeparatingPostures, AreRefusedForWhatIsNoneOfPostures) {
  options_.separate = {"tool_step"};
  EXPECT_THROW(DesignPostures(robot_, options_), OptionError);
  options_.separate = {"motor_harmonic"};  // without gear ratios
  EXPECT_THROW(DesignPostures(robot_, options_), OptionError);
}

}  // namespace armcal::posture_model_test
