#include "calib/diagnose/select/reference_fit.h"

#include "calib/diagnose/data/segments.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::reference_fit_test {

// The arm with all that its file says of masses and friction times `factor`, as
// torques in a wrong unit, or by a wrong torque constant, make it look.
Robot Times(double factor, Robot robot) {
  for (Link& link : robot.links) {
    link.inertial.mass *= factor;
    link.inertial.first_moment *= factor;
    link.inertial.inertia *= factor;
    link.joint.viscous *= factor;
    link.joint.coulomb *= factor;
    link.joint.armature *= factor;
  }
  return robot;
}

class ReferenceFitTest : public DiagnosedArm<32> {
 protected:
  static constexpr double kBandwidth = 6;  // Hz

  // Standard deviation of what the model leaves of each joint's torque over
  // that of the noise that torques were given, of which the bandwidth leaves a
  // part.
  Eigen::RowVectorXd LeftOfNoise(const Robot& file) {
    LogReaderOptions reader;
    reader.joint_names = file.JointNames();
    const LogSet logs({Record(truth_, "log.csv")}, reader, {});
    const std::vector<GapSegment> segments = ReadSegments(kBandwidth, {}, logs);
    const GapBaseline baseline(file, {}, UsualTorque(segments));
    GapData data(segments, baseline, kBandwidth);
    const Eigen::MatrixXd left = Moving(
        data.rows(), data.ResidualWith(FitModelWithNoise(baseline, &data)));
    const double white =
        kNoise * std::sqrt(kBandwidth / (EffectPlant::kLogRate / 2));
    return (left.colwise().squaredNorm() / left.rows()).cwiseSqrt() / white;
  }
};

TEST_F(ReferenceFitTest, LeavesTheNoise) {
  EXPECT_LT(LeftOfNoise(File()).maxCoeff(), 1.2);
}

// A prior that holds the file's values to a few per cent must not pass for
// noise: with the noise of what such values leave, it would.
TEST_F(ReferenceFitTest, LeavesTheNoiseOfAFileThatIsFarOff) {
  EXPECT_LT(LeftOfNoise(Times(.45, File())).maxCoeff(), 1.3);
  EXPECT_LT(LeftOfNoise(Times(2, File())).maxCoeff(), 1.3);
}

}  // namespace armcal::reference_fit_test
