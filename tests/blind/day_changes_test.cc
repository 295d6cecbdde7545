#include "tests/blind/day_changes.h"

#include <gtest/gtest.h>

namespace armcal::day_changes_test {

BlindAnswer::Effect Claim(const std::string& effect, int joint, double value) {
  return {{effect, joint}, .9, {{"coulomb", "N m", value}}, {}};
}

// Hid 2 N m more Coulomb friction on joint 3.
BlindLabel Label() {
  BlindLabel label;
  label.effects = {
      {{"coulomb_friction", 3}, true, 1, {{"coulomb", "N m", 2}}, ""}};
  return label;
}

std::vector<std::string> Left(const std::vector<BlindAnswer::Effect>& claims,
                              const std::vector<BlindAnswer::Effect>& before) {
  BlindAnswer answer, untouched;
  answer.effects = claims;
  untouched.effects = before;
  std::vector<std::string> left;
  for (const BlindAnswer::Effect& effect :
       WithoutDayChanges(Label(), answer, untouched).effects) {
    left.push_back(effect.placed.Text());
  }
  return left;
}

using Texts = std::vector<std::string>;

TEST(WithoutDayChanges, LeavesWhatTheUntouchedLogDoesNotShow) {
  EXPECT_EQ(
      Left({Claim("viscous_friction", 1, 3), Claim("coulomb_friction", 3, 2)},
           {Claim("viscous_friction", 1, 4)}),
      Texts{"coulomb_friction@3"});
  EXPECT_EQ(Left({Claim("viscous_friction", 1, 3)},
                 {Claim("viscous_friction", 2, 3)}),
            Texts{"viscous_friction@1"})
      << "of another joint";
}

// The day changed the same: only what the case added is found by the diagnosis.
TEST(WithoutDayChanges, TheTruthHasToMove) {
  const auto before = {Claim("coulomb_friction", 3, -1)};
  EXPECT_EQ(Left({Claim("coulomb_friction", 3, 1)}, before),
            Texts{"coulomb_friction@3"});
  EXPECT_EQ(Left({Claim("coulomb_friction", 3, -.5)}, before), Texts{});
  EXPECT_EQ(Left({Claim("coulomb_friction", 3, -3)}, before), Texts{})
      << "the other way";
}

}  // namespace armcal::day_changes_test
