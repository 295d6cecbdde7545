#include "model/text/yaml_node.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/fixtures/yaml_text.h"

namespace armcal::yaml_node_test {

using namespace yaml_text;

class YamlNodeRefusal : public testing::TestWithParam<Case> {};

TEST_P(YamlNodeRefusal, SaysWhereAndWhy) {
  EXPECT_EQ(Refusal(GetParam()), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, YamlNodeRefusal,
    testing::Values(
        Case{"a: 0.4", "a: 40cm",
             "line 8, links[1].a: found '40cm': expected a number in m"},
        Case{"a: 0.4", "a: 0,4",
             "line 8, links[1].a: found '0,4': expected a number in m, with a "
             "decimal point"},
        Case{"a: 0.4", "a: .nan",
             "line 8, links[1].a: found '.nan': expected a number in m"},
        Case{"a: 0.4", "a: inf",
             "line 8, links[1].a: found 'inf': expected a finite number in m"},
        Case{"a: 0.4", "a: [1, 2]",
             "line 8, links[1].a: found '[1, 2]': expected a number in m"},
        Case{"a: 0.4", "a:", "line 8, links[1].a: expected a number in m"},
        Case{"alpha: 0", "a: 0.5",
             "line 9, links[1]: found 'a': the key is given twice"},
        Case{"alpha: 0", "alhpa: 0",
             "line 9, links[1]: found 'alhpa': expected one of the keys name, "
             "joint, joint_name, a, d, alpha, theta, unknown, mass, com, "
             "inertia, "
             "limits, viscous, coulomb, armature, offset, zero, inertial, "
             "parent"},
        Case{"name: scara", "base: b",
             "line 1: found 'base': expected one of the keys name, gravity, "
             "convention, links, tool"},
        Case{"standard", "craig",
             "line 3, convention: found 'craig': expected one of standard, "
             "modified, poses"},
        Case{"    joint: revolute\n", "",
             "line 5, links[1]: expected a key 'joint'"},
        Case{"[0, 0, 9.8]", "[0, 9.8]",
             "line 2, gravity: found '[0, 9.8]': expected a list of three "
             "numbers in m/s^2"},
        Case{"[0, 0, 9.8]", "[0, 0, g]",
             "line 2, gravity[3]: found 'g': expected a number in m/s^2"},
        Case{"[a, d]", "[a, a]",
             "line 17, links[1].unknown[2]: found 'a': the name is given "
             "twice"},
        Case{"name: scara", "name: [",
             "line 3: not well-formed YAML (end of sequence flow not found)"},
        Case{"tool: {", "---\ntool: {",
             "expected one YAML document and nothing after it"}));

TEST(YamlNodeTest, WholeFiles) {
  EXPECT_EQ(Refusal(""), "the file is empty");
  EXPECT_EQ(Refusal("# nothing\n"),
            "expected one YAML document and nothing after it");
  // 2026-11-20: yaml-cpp's LoadAll looped for ever on this, found by fuzzing.
  EXPECT_EQ(Refusal(" , a: 1}\n"),
            "expected one YAML document and nothing after it");
  EXPECT_EQ(Refusal("name: a\n}\n"),
            "line 2: not well-formed YAML (illegal flow end)");
  EXPECT_EQ(Refusal("5\n"),
            "line 1: found '5': expected a map with the keys name, gravity, "
            "convention, links, tool");
  EXPECT_EQ(
      Refusal("convention: standard\nlinks: &a [*a]\n"),
      "line 2, links[1]: found 'a list of 1': expected a map with the "
      "keys name, joint, joint_name, a, d, alpha, theta, unknown, mass, com, "
      "inertia, limits, viscous, coulomb, armature, offset, zero, inertial, "
      "parent");
  EXPECT_EQ(Refusal("links: " + std::string(100000, '[')),
            "line 1: lists and maps are nested too deeply");
}

}  // namespace armcal::yaml_node_test
