// Gears that lose another share of power when the load drives them than when
// they drive it: the catalogue has no law of its own for them, since load
// friction and a torque gain are that law. Worked out here from what
// efficiencies mean.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/fixtures/effect_arm.h"

namespace armcal::gear_efficiency_test {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kJoint = 4;  // of a wrist, whose load has either sign

// Coefficients of load friction, of a torque gain and of the joint terms that
// the gain takes along, and what they leave, rms over that of `lost`.
struct Explained {
  VectorXd x;
  double left;
};

class GearEfficiency : public testing::Test {
 protected:
  GearEfficiency() : arm_("UR5 6R", 8, .002) {
    v_ = arm_.motion.qd.col(kJoint).array();
    load_ = recorded_.load().col(kJoint).array();
  }

  // What the motor gives beyond the load: load / driving - load where the gear
  // drives it, (load v > 0), load driven - load where the load drives the gear.
  VectorXd Lost(double driving, double driven) const {
    return (load_ * v_ > 0)
        .select(load_ / driving - load_, load_ * driven - load_)
        .matrix();
  }
  VectorXd ColumnOf(const char* name) {
    const Effect& effect = *FindEffect(name);
    VectorXd p = arm_.Sizes(effect, kJoint);
    return arm_.Change(effect, kJoint, p, &recorded_).col(kJoint) / p[0];
  }
  // Of samples that are clear of the width over which friction changes sign.
  Explained Explain(const VectorXd& lost,
                    const std::vector<const char*>& effects) {
    const ArrayXd clear = (v_.abs() > 5 * .02).cast<double>();
    MatrixXd columns(lost.size(), effects.size());
    for (size_t k = 0; k < effects.size(); ++k) {
      columns.col(static_cast<Eigen::Index>(k)) =
          ColumnOf(effects[k]).array() * clear;
    }
    const VectorXd y = lost.array() * clear;
    const VectorXd x = columns.colPivHouseholderQr().solve(y);
    return {x, (y - columns * x).norm() / y.norm()};
  }

  EffectArm arm_;
  RecordedTorque recorded_ = arm_.Recorded();
  ArrayXd v_, load_;
};

// With a = 1 / driving - 1 and b = 1 - driven, what is lost is
//   (a + b) / 2 |load| sign(v) + (a - b) / 2 load.
TEST_F(GearEfficiency, IsLoadFrictionAndAGain) {
  constexpr double kDriving = .7, kDriven = .4;
  constexpr double a = 1 / kDriving - 1, b = 1 - kDriven;
  const std::vector<const char*> together = {"load_friction", "torque_gain",
                                             "armature", "viscous_friction",
                                             "coulomb_friction"};
  const VectorXd lost = Lost(kDriving, kDriven);
  EXPECT_NEAR((load_ > 0).cast<double>().mean(), .5, .4) << "of either sign";
  const Explained both = Explain(lost, together);
  EXPECT_LT(both.left, .01);
  EXPECT_NEAR(both.x[0], (a + b) / 2, .01 * (a + b) / 2);
  EXPECT_NEAR(both.x[1], (a - b) / 2, .05 * std::abs(a - b) / 2);
  EXPECT_GT(Explain(lost, {"load_friction"}).left, .1) << "the gain is needed";
}

// Where 1 / driving - 1 = 1 - driven the gain is not needed.
TEST_F(GearEfficiency, IsLoadFrictionAloneWhereBothWaysAreAlike) {
  constexpr double kFriction = .05;
  const VectorXd lost = Lost(1 / (1 + kFriction), 1 - kFriction);
  const Explained alone = Explain(lost, {"load_friction"});
  EXPECT_LT(alone.left, .01);
  EXPECT_NEAR(alone.x[0], kFriction, .01 * kFriction);
}

}  // namespace armcal::gear_efficiency_test
