#include "model/robot_files/sdf_inertial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "model/dynamics/forward_dynamics.h"
#include "model/robot_files/sdf_reader.h"

namespace armcal::sdf_inertial_test {

using Eigen::Vector2d;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// Two joints at one point, and the link between them with this <inertial>.
Robot Read(const std::string& inertial) {
  return ReadSdf(
      {"arm.sdf",
       "<sdf version='1.9'><model name='m'><link name='base'/>"
       "<joint name='f' type='fixed'><parent>world</parent><child>base</child>"
       "</joint><link name='a'><pose relative_to='base'>0 0 0.5 0 0 0</pose>" +
           inertial +
           "</link><joint name='j1' type='revolute'><parent>base</parent>"
           "<child>a</child><axis><xyz>0 1 0</xyz></axis></joint>"
           "<link name='b'><pose relative_to='a'>0 0 0 0 0 0</pose><inertial>"
           "<pose>0 0 .2 0 0 0</pose><mass>2</mass><inertia><ixx>.02</ixx>"
           "<iyy>.02</iyy><izz>.01</izz></inertia></inertial></link>"
           "<joint name='j2' type='revolute'><parent>a</parent><child>b</child>"
           "<axis><xyz>1 0 0</xyz></axis></joint></model></sdf>"},
      {});
}

// Of the first joint at (0.3, 0.2): Drake 1.51.1's mass matrix (kg m^2) and
// torque that holds the weight (N m).
struct Case {
  const char* inertial;
  double inertia, weight;
  const char* note;
};

TEST(ReadSdfInertial, WhatIsNotSaidIsTheSpecificationsDefault) {
  for (const Case& c :
       {Case{"", 1.0964477447301297, -1.1365060702025231,
             "link 'a' has no <inertial>: SDF's default counts, 1 kg and 1 kg "
             "m^2"},
        {"<inertial><pose>0.1 0 0 0 0 0</pose></inertial>", 1.1064477447301297,
         -2.0736911660347426, "link 'a' has no <mass>: SDF's default counts"},
        {"<inertial><pose>0.1 0 0 0 0 0</pose><mass>3</mass></inertial>",
         1.12644774473013, -3.948061357699182,
         "link 'a' has no <inertia>: SDF's default counts, 1 kg m^2"},
        {"<inertial><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz>"
         "</inertia></inertial>",
         0.19644774473012983, -1.1365060702025231,
         "link 'a' has no <mass>: SDF's default counts, 1 kg"},
        {"<inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz>"
         "</inertia></inertial>",
         0.09644774473012985, -1.1365060702025231, "link 'a' has mass 0"}}) {
    SCOPED_TRACE(c.inertial);
    const Robot robot = Read(c.inertial);
    const Vector2d q(.3, .2);
    EXPECT_NEAR(MassMatrix(robot, q)(0, 0), c.inertia, 1e-12);
    EXPECT_NEAR(GravityTorque(robot, q)[0], c.weight, 1e-12);
    EXPECT_THAT(robot.notes, Contains(HasSubstr(c.note)));
  }
}

TEST(ReadSdfInertial, NothingIsNotedOfWhatIsSaid) {
  EXPECT_THAT(Read("<inertial><mass>1</mass><inertia/></inertial>").notes,
              Not(Contains(HasSubstr("link 'a'"))));
}

}  // namespace armcal::sdf_inertial_test
