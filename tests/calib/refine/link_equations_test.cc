#include "calib/refine/link_equations.h"

#include <gtest/gtest.h>

#include "calib/linear/calibrate_linear.h"
#include "tests/calib/refine/bent_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::link_equations_test {

using Eigen::VectorXd;

// A log without noise of an arm whose geometry is not its file's, and what
// calibrates it.
struct Case {
  Case() : arm("UR5 6R", 3), logs(Open()) {
    LinearCalibrationOptions options;
    options.transition = BentArm::kWidth;
    options.bandwidth_hz = 0;
    linear.emplace(CalibrateLinear(arm.file, options, logs, nullptr));
    unknowns.emplace(arm.file, *linear, RefineGeometry::kAll, nullptr);
  }
  LogSet Open() {
    LogReaderOptions reader;
    reader.joint_names = arm.file.JointNames();
    return LogSet({WriteFile(LogCsv(arm.Move(4, .004)))}, reader, {});
  }
  // Part of the way from the truth to the file.
  ArmValues Values(double part) const {
    ArmValues values = unknowns->nominal();
    VectorXd truth = values.Stacked();
    for (int k = 0; k < unknowns->size(); ++k) {
      const std::string& name = unknowns->name(k);
      if (name.rfind("instrument", 0) == 0) continue;
      truth[k] = arm.ValueOf({name, "", 0, 0, 0, true, false, false});
    }
    values.SetStacked(truth + part * (values.Stacked() - truth));
    return values;
  }
  PreparedLogs Prepared() const { return Prepare(logs, linear->preparation); }
  double Misfit(double part) {
    const LinkEquations equations =
        LinkPass(*unknowns, *linear, {}, Prepared())
            .Reduce(Values(part), VectorXd::Ones(6));
    return (equations.R * Values(0).Stacked() - equations.z).norm();
  }

  BentArm arm;
  LogSet logs;
  std::optional<LinearCalibration> linear;
  std::optional<ArmUnknowns> unknowns;
};

// Taken linearly about the truth the equations hold there to the quadrature's
// exactness; about other geometry and inertia, to second order of the distance.
TEST(LinkEquations, HoldAtTheTruthToSecondOrder) {
  Case c;
  const double torque = LinkPass(*c.unknowns, *c.linear, {}, c.Prepared())
                            .Reduce(c.Values(0), VectorXd::Ones(6))
                            .z.norm();
  const double exact = c.Misfit(0);
  EXPECT_LT(exact, 2e-4 * torque);  // friction's sharp changes, sampled
  const double near = c.Misfit(4), far = c.Misfit(8);
  EXPECT_GT(near, 5 * exact);
  EXPECT_NEAR(far / near, 4, .6);
}

// The spread of residuals in units of the noise that is given.
TEST(LinkEquations, SpreadIsInUnitsOfTheNoise) {
  Case c;
  LinkPass pass(*c.unknowns, *c.linear, {}, c.Prepared());
  const VectorXd one = pass.Reduce(c.Values(1), VectorXd::Ones(6)).spread;
  const VectorXd two =
      pass.Reduce(c.Values(1), VectorXd::Constant(6, 2)).spread;
  for (int j = 0; j < 6; ++j) EXPECT_NEAR(one[j] / two[j], 2, .02);
}

// With the loss quadratic everywhere both are the same equations.
TEST(LinkEquations, InformationIsThatOfTheEquations) {
  Case c;
  c.linear->loss = RobustLoss::kSquared;
  c.linear->fitted_transitions = false;
  LinkPass pass(*c.unknowns, *c.linear, {}, c.Prepared());
  const VectorXd noise = VectorXd::Constant(6, .1);
  const int size = c.unknowns->size();
  const Eigen::MatrixXd R = pass.Reduce(c.Values(0), noise).R;
  const LinkInformation information =
      pass.Inform(c.Values(0), noise, Eigen::MatrixXd::Zero(0, size),
                  Eigen::MatrixXd::Identity(size, size));
  const Eigen::MatrixXd H = R.transpose() * R;
  const auto& Q = information.R;
  EXPECT_LT((Q.transpose() * Q - H).norm(), 1e-9 * H.norm());
}

}  // namespace armcal::link_equations_test
