#include "model/robot_files/urdf_elements.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/urdf_text.h"

namespace armcal::urdf_elements_test {

using namespace urdf_text;

class UrdfElement : public testing::TestWithParam<Case> {};

TEST_P(UrdfElement, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

#define MASS "line 7, <mass value> of link 'upper': "
#define INERTIA "line 8, <inertia "
#define NAMES "expected one of the links base, upper, fore"

INSTANTIATE_TEST_SUITE_P(
    Numbers, UrdfElement,
    testing::Values(
        Case{"\"2\"", "\"two\"", MASS "found 'two': expected a number in kg"},
        Case{"\"2\"", "\"2kg\"", MASS "found '2kg': expected a number in kg"},
        Case{"\"2\"", "\"+-2\"", MASS "found '+-2': expected a number in kg"},
        Case{"\"2\"", "\"0x2\"", MASS "found '0x2': expected a number in kg"},
        Case{"\"2\"", "\"2 3\"", MASS "found '2 3': expected a number in kg"},
        Case{"\"2\"", "\"\"", MASS "expected a number in kg"},
        Case{"\"2\"", "\"2,5\"",
             MASS "found '2,5': expected a number in kg, with a decimal point"},
        Case{"\"2\"", "\"nan\"",
             MASS "found 'nan': expected a finite number in kg"},
        Case{"\"2\"", "\"inf\"",
             MASS "found 'inf': expected a finite number in kg"},
        Case{"\"2\"", "\"1e400\"",
             MASS "found '1e400': expected a number in kg"},
        Case{"\"2\"", "\"-2\"",
             MASS "found '-2': expected a number in kg that is not negative"},
        Case{"\"2\"", "\"${m}\"",
             MASS "found '${m}': expected a plain URDF: run xacro first (xacro "
                  "robot.urdf.xacro > robot.urdf)"},
        Case{"value=\"2\"", "",
             "line 7, <mass> of link 'upper': expected an attribute 'value'"},
        Case{"ixx=\"0.1\"", "ixx=\"-0.1\"",
             INERTIA "ixx> of link 'upper': found '-0.1': expected a number in "
                     "kg m^2 that is not negative"},
        Case{"iyz=\"0\"", "iyz=\"inf\"",
             INERTIA "iyz> of link 'upper': found 'inf': expected a finite "
                     "number in kg m^2"},
        Case{"iyz=\"0\"", "",
             "line 8, <inertia> of link 'upper': expected an attribute 'iyz'"},
        Case{"0.1 0 0", "0.1 0",
             "line 6, <origin xyz> of link 'upper': found '0.1 0': expected "
             "three numbers in m"},
        Case{"rpy=\"0 0 0\"/>\n    <axis", "rpy=\"0 nan 0\"/>\n    <axis",
             "line 14, <origin rpy> of joint 'shoulder': found '0 nan 0': "
             "expected three finite numbers in rad"},
        Case{"0 0 1", "0 0 0",
             "line 15, <axis xyz> of joint 'shoulder': found '0 0 0': expected "
             "an axis that is not zero"},
        Case{"lower=\"-1\"", "lower=\"3\"",
             "line 16, <limit lower> of joint 'shoulder': found '3': expected "
             "at most the upper limit 2"},
        Case{"velocity=\"3\"", "velocity=\"-3\"",
             "line 16, <limit velocity> of joint 'shoulder': found '-3': "
             "expected a number in rad/s that is not negative"},
        Case{"damping=\"0.5\"", "damping=\"-0.5\"",
             "line 17, <dynamics damping> of joint 'shoulder': found '-0.5': "
             "expected a number in N m s/rad that is not negative"}));

INSTANTIATE_TEST_SUITE_P(
    Structure, UrdfElement,
    testing::Values(
        Case{"\"fore\"", "\"base\"",
             "line 19, <link name>: found 'base': expected a name that is not "
             "yet used (line 3)"},
        Case{"\"elbow\"", "\"shoulder\"",
             "line 20, <joint name>: found 'shoulder': expected a name that is "
             "not yet used (line 11)"},
        Case{"name=\"fore\"", "",
             "line 19, <link>: expected an attribute 'name'"},
        Case{"\"fore\"", "\" \"",
             "line 19, <link name>: found ' ': expected a name"},
        Case{"\"fore\"", "\"a&#10;b\"",
             "line 19, <link name>: found 'a b': expected a name without "
             "control characters"},
        Case{"<parent link=\"base\"/>", "",
             "line 11, joint 'shoulder': expected an element <parent>"},
        Case{"<child link=\"upper\"/>", "",
             "line 11, joint 'shoulder': expected an element <child>"},
        Case{"<parent link=\"base\"/>",
             "<parent link=\"base\"/> <parent link=\"base\"/>",
             "line 12, <parent> of joint 'shoulder': expected only one "
             "<parent> element"},
        Case{" type=\"revolute\"", "",
             "line 11, joint 'shoulder': expected an attribute 'type'"},
        Case{"revolute", "hinge",
             "line 11, <joint type> of joint 'shoulder': found 'hinge': "
             "expected revolute, continuous, prismatic, fixed, floating or "
             "planar"},
        Case{"parent link=\"base\"", "parent link=\"table\"",
             "line 12, <parent link> of joint 'shoulder': found "
             "'table': " NAMES},
        Case{"child link=\"fore\"", "child link=\"hand\"",
             "line 22, <child link> of joint 'elbow': found 'hand': " NAMES},
        Case{"child link=\"fore\"", "child link=\"upper\"",
             "line 22, <child link> of joint 'elbow': found 'upper': expected "
             "a link with one parent: joint 'shoulder' has it as its child "
             "already"},
        Case{"parent link=\"base\"", "parent link=\"fore\"",
             "line 11, joint 'shoulder': expected a tree: the links fore, "
             "upper form a loop"},
        Case{"parent link=\"base\"", "parent link=\"upper\"",
             "line 11, joint 'shoulder': expected a tree: the links upper form "
             "a loop"}));

}  // namespace armcal::urdf_elements_test
