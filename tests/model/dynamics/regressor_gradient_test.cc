#include "model/dynamics/regressor_gradient.h"

#include <gtest/gtest.h>

#include "model/dynamics/model_parameters.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::regressor_gradient_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Against central differences of the regressor itself, whose d/dt P is
// automatic differentiation of other depth.
void CheckGradient(const Robot& robot, GeometryKnowledge geometry,
                   std::mt19937_64* random) {
  const int n = robot.num_joints();
  ModelParameters::Options options;
  options.geometry = geometry;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  options.transitions.assign(n, {{CoulombTransition::Law::kVelocity, .7}});
  const ModelParameters model(robot, options);
  Regressor regressor = model.MakeRegressor();
  RegressorGradient gradient(MakeProximalChain(robot), model.unknown_lengths(),
                             regressor.columns());
  const MatrixXd G =
      UniformVector(random, n * model.size(), -1, 1).reshaped(n, model.size());
  const VectorXd x = UniformVector(random, 3 * n, -2, 2);
  const auto sum = [&](const VectorXd& at) {
    const VectorXd qd = at.segment(n, n);
    MatrixXd U;
    VectorXd c(n);
    for (int j = 0; j < n; ++j) c[j] = options.transitions[j][0].C(qd[j], 0);
    regressor.Differential(at.head(n), qd, at.tail(n), c, &U);
    return U.cwiseProduct(G).sum();
  };
  // Added to what is there.
  VectorXd of_q = VectorXd::Ones(n), of_qd = of_q, of_qdd = of_q;
  gradient.Add(x.head(n), x.segment(n, n), x.tail(n), G, &of_q, &of_qd,
               &of_qdd);
  VectorXd found(3 * n);
  found << of_q, of_qd, of_qdd;
  for (int k = 0; k < 3 * n; ++k) {
    constexpr double h = 1e-4;
    const VectorXd step = h * VectorXd::Unit(3 * n, k);
    EXPECT_NEAR(found[k] - 1, (sum(x + step) - sum(x - step)) / (2 * h),
                1e-5 * G.norm())
        << robot.name << ", direction " << k;
  }
}

TEST(RegressorGradient, IsThatOfTheRegressor) {
  std::mt19937_64 random(5);
  for (const char* name : {"SCARA RRPR", "PUMA560 6R", "Panda 7R"}) {
    CheckGradient(SampleRobot(name), GeometryKnowledge::kKnown, &random);
    CheckGradient(SampleRobot(name), GeometryKnowledge::kAllLengths, &random);
  }
}

TEST(RegressorGradient, OfAnyArm) {
  std::mt19937_64 random(6);
  for (int n = 1; n <= 9; ++n) {
    CheckGradient(RandomArm(n, &random), GeometryKnowledge::kNonzeroLengths,
                  &random);
  }
}

}  // namespace armcal::regressor_gradient_test
