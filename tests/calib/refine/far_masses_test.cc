#include "calib/refine/far_masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::far_masses_test {

using testing::HasSubstr;
using testing::Not;

class FarMassesTest : public testing::Test {
 protected:
  FarMassesTest() {
    found_.solved = true;
    found_.robot = found_.nominal = InspectedArm("3R elbow").robot;
  }
  double& Mass(int link) { return found_.robot.links[link].inertial.mass; }

  NonlinearCalibration found_;
};

TEST_F(FarMassesTest, NineTimesAreNotFar) {
  Mass(0) *= 9;
  Mass(1) /= 9;
  EXPECT_EQ(WhatMassesAreFar(found_), "");
}

TEST_F(FarMassesTest, ElevenTimesAre) {
  Mass(0) *= 11;
  const std::string one = WhatMassesAreFar(found_);
  EXPECT_THAT(one, HasSubstr("link1 ("));
  EXPECT_THAT(one, HasSubstr("ten times the mass"));
  EXPECT_THAT(one, HasSubstr("gravity"));
  EXPECT_THAT(one, Not(HasSubstr("link2")));
  Mass(2) /= 11;
  EXPECT_THAT(WhatMassesAreFar(found_), HasSubstr(") and link3 ("));
}

TEST_F(FarMassesTest, AFileWithoutMassesTellsNothing) {
  found_.nominal.links[0].inertial.mass = 0;
  EXPECT_EQ(WhatMassesAreFar(found_), "");
}

}  // namespace armcal::far_masses_test
