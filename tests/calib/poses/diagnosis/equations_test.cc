// Derivatives of displaced poses by all that moves them, against differences.

#include "calib/poses/diagnosis/equations.h"

#include <gtest/gtest.h>

#include "calib/poses/start.h"
#include "tests/fixtures/hidden_poses.h"

namespace armcal::equations_test {

using Acts = PoseTerm::Acts;

std::vector<PoseTerm> AllTerms(const PoseMeasurements& m) {
  std::vector<PoseTerm> terms;
  const auto add = [&](Acts acts, int count) {
    for (int k = 0; k < count; ++k) {
      terms.push_back(
          {acts, k, Eigen::VectorXd::LinSpaced(m.size(), .5, 2), "", ""});
    }
  };
  add(Acts::kJoint, static_cast<int>(m.q.cols()));
  add(Acts::kBase, 3);
  add(Acts::kTool, 6);
  add(Acts::kFrame, 6);
  add(Acts::kScale, 1);
  add(Acts::kLength, 1);
  add(Acts::kTarget, 3 * static_cast<int>(m.targets.size()));
  return terms;
}

TEST(PoseEquations, DerivativesAreThoseOfTheResiduals) {
  for (const auto instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    const HiddenPoses arm("PUMA560 6R", instrument, 2, 8, 3);
    const PoseMeasurements m = arm.Measure({}, 1e-3, 4);
    const PoseCalibrationOptions options;
    const PoseFit fit(arm.nominal(), m, options);
    PoseEquations equations(fit, m);
    equations.set_rotation_length(.7);
    equations.SetFree(fit.Wanted(RefineGeometry::kAll));
    const auto terms = AllTerms(m);
    PoseState at;
    at.unknowns = StartPoses(fit.geometry(), m);
    at.amounts = Eigen::VectorXd::Constant(terms.size(), 1e-3);
    const LinearPoses linear = equations.Linearise(terms, at, true);
    Eigen::MatrixXd J(linear.r.size(), equations.num_free() + terms.size());
    J << linear.geometry, equations.Columns(linear, terms);
    for (Eigen::Index k = 0; k < J.cols(); ++k) {
      const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(J.cols(), k);
      const Eigen::VectorXd difference =
          (equations.Residuals(terms, equations.Moved(at, step)) -
           equations.Residuals(terms, equations.Moved(at, -step))) /
          2e-6;
      // Rotations of residuals and of several terms do not commute, which is
      // left out as in Gauss's method: all are a hundredth here, by levers
      // of about a metre.
      EXPECT_LT((J.col(k) - difference).norm(), 3e-2 * (1 + difference.norm()))
          << k;
    }
  }
}

}  // namespace armcal::equations_test
