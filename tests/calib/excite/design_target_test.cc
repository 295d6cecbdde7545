#include "calib/excite/design_target.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/fixtures/sample_robots.h"

namespace armcal::design_target_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<JointTerm> kTerms = {JointTerm::kViscous,
                                       JointTerm::kArmature};

class DesignTargetTest : public testing::Test {
 protected:
  DesignTargetTest() : robot_(SampleRobot("3R elbow")) {
    std::mt19937_64 random(3);
    SetRandomInertials(&random, &robot_);
  }
  ModelParameters Model(DesignTarget target) const {
    ModelParameters::Options options;
    options.joint_terms = kTerms;
    if (target == DesignTarget::kGeometry) {
      options.geometry = GeometryKnowledge::kNonzeroLengths;
    }
    return {robot_, options};
  }
  NamedQuantities Quantities(DesignTarget target) const {
    const ModelParameters model = Model(target);
    const VectorXd x = model.Values(robot_);
    const ReferenceScale reference =
        MakeReferenceScale(model, 1, .5, 1, VectorXd::Zero(3), x);
    return MakeDesignQuantities(robot_, model, kTerms, target, {}, reference,
                                MatrixXd::Zero(model.size(), model.size()));
  }
  Robot robot_;
};

TEST_F(DesignTargetTest, ModelParametersAreThemselves) {
  const NamedQuantities all = Quantities(DesignTarget::kModel);
  const int m = static_cast<int>(all.names.size());
  EXPECT_EQ(all.design.J, MatrixXd::Identity(m, m));
  EXPECT_EQ(static_cast<int>(all.design.wanted.size()), m);
}

// What the model parameters follow from: their change with one quantity is its
// column, to first order.
TEST_F(DesignTargetTest, ColumnsAreDerivatives) {
  const ModelParameters model = Model(DesignTarget::kPhysical);
  const NamedQuantities physical = Quantities(DesignTarget::kPhysical);
  ASSERT_EQ(physical.names.size(), 3u * 10 + 3 * 2);
  Robot heavier = robot_;
  heavier.links[1].inertial.mass += .1;
  heavier.links[2].joint.viscous += .3;
  VectorXd change = VectorXd::Zero(36);
  for (int k = 0; k < 36; ++k) {
    if (physical.names[k] == robot_.links[1].name + ".mass") change[k] = .1;
    if (physical.names[k] == robot_.links[2].joint.name + ".viscous") {
      change[k] = .3;
    }
  }
  EXPECT_EQ((change.array() != 0).count(), 2);
  const VectorXd expected = model.Values(heavier) - model.Values(robot_);
  EXPECT_LT((physical.design.J * change - expected).norm(),
            1e-9 * expected.norm());
}

// Inertias have a prior, which makes their information positive; a geometry is
// asked for by its lengths alone.
TEST_F(DesignTargetTest, PriorsAndWishes) {
  const NamedQuantities physical = Quantities(DesignTarget::kPhysical);
  EXPECT_EQ(physical.design.known.topLeftCorner(30, 30).llt().info(),
            Eigen::Success);
  const NamedQuantities geometry = Quantities(DesignTarget::kGeometry);
  ASSERT_FALSE(geometry.design.wanted.empty());
  for (const int k : geometry.design.wanted) {
    EXPECT_EQ(geometry.units[k], "m") << geometry.names[k];
  }
  EXPECT_EQ(geometry.design.scale.size(),
            static_cast<long>(geometry.design.wanted.size()));
}

}  // namespace armcal::design_target_test
