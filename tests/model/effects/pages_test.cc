// docs/effects has a page for every effect, and each page the law, names and
// units of the code.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "model/effects/effects.h"

namespace armcal::pages_test {

const std::filesystem::path kPages = DATA_DIR "/../docs/effects";

std::string Page(const std::string& name) {
  std::ifstream file(kPages / (name + ".md"));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// "| `viscous` | N m s/rad; N s/m |", as the tables of the pages have it.
std::string Row(const std::string& name, const std::string& turning,
                const std::string& sliding) {
  const std::string unit =
      turning == sliding ? turning : turning + "; " + sliding;
  return "| `" + name + "` | " + unit + " |";
}

// An arm of both kinds of joints, on which every effect can be asked.
Robot Arm() {
  Robot robot;
  robot.gravity = {0, 0, -9.81};
  robot.links.resize(3);
  robot.links[2].joint.type = JointType::kPrismatic;
  for (Link& link : robot.links) {
    link.inertial.mass = 1;
    link.inertial.inertia = Eigen::Matrix3d::Identity();
  }
  return robot;
}

MotionScale Scale() {
  MotionScale scale;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(3);
  scale.torque = scale.load = scale.speed = scale.top_speed = ones;
  scale.acceleration = scale.high = scale.width = ones;
  scale.low = -ones;
  scale.end = 1;
  return scale;
}

class EffectPage : public testing::TestWithParam<Effect> {};

TEST_P(EffectPage, HasTheLaw) {
  const std::string page = Page(GetParam().name);
  ASSERT_FALSE(page.empty()) << "docs/effects/" << GetParam().name << ".md";
  EXPECT_NE(page.find("\n" + GetParam().law + "\n"), std::string::npos)
      << "the law is: " << GetParam().law;
}

TEST_P(EffectPage, HasEveryParameterWithItsUnits) {
  const std::string page = Page(GetParam().name);
  for (const EffectParameter& parameter : GetParam().parameters) {
    const std::string row =
        Row(parameter.name, ParameterUnit(parameter.unit, JointType::kRevolute),
            ParameterUnit(parameter.unit, JointType::kPrismatic));
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST_P(EffectPage, HasEveryEstimateWithItsUnits) {
  const Effect& effect = GetParam();
  const std::string page = Page(effect.name);
  const Robot arm = Arm();
  const MotionScale scale = Scale();
  const bool whole = effect.scope == Effect::Scope::kRobot;
  const Eigen::VectorXd p = Eigen::VectorXd::Ones(effect.parameters.size());
  const auto turning = EstimatesOf(effect, {&arm, whole ? -1 : 1, &scale}, p);
  const auto sliding = EstimatesOf(effect, {&arm, whole ? -1 : 2, &scale}, p);
  ASSERT_EQ(turning.size(), sliding.size());
  for (size_t k = 0; k < turning.size(); ++k) {
    const std::string row =
        Row(turning[k].name, turning[k].unit, sliding[k].unit);
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectPage, testing::ValuesIn(Effects()),
                         [](const auto& info) { return info.param.name; });

TEST(EffectPages, AreOfEffects) {
  for (const auto& file : std::filesystem::directory_iterator(kPages)) {
    const std::string name = file.path().stem();
    if (file.path().extension() != ".md" || name == "README") continue;
    EXPECT_NE(FindEffect(name), nullptr) << file.path();
  }
}

}  // namespace armcal::pages_test
