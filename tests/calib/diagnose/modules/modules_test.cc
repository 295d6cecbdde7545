// The modules' own laws, in Python and in C, do what those of the catalogue do.

#include "calib/diagnose/modules/modules.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "calib/diagnose/modules/effects_json.h"
#include "tests/calib/diagnose/modules/moved_arm.h"
#include "tests/fixtures/effect_arm.h"  // names of effects

namespace armcal::modules_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A folder with the modules of a robot.
std::string Written(const CorrectedRobot& robot, const std::string& name) {
  const std::string folder = testing::TempDir() + "modules_" + name;
  mkdir(folder.c_str(), 0755);
  std::ofstream(folder + "/effects.json") << EffectsJson(robot).dump(2);
  for (const EffectModule& module : MakeEffectModules(robot, {"python", "c"})) {
    for (const auto& [file, text] : module.files) {
      std::ofstream(folder + "/" + file) << text;
    }
  }
  return folder;
}

int Returned(const std::string& command) {
  return std::system(command.c_str());
}

// Both agree with the laws to 1e-9 at each of 50 steps.
void Agree(const CorrectedRobot& robot, const std::string& name) {
  SCOPED_TRACE(name);
  const std::string folder = Written(robot, name);
  EXPECT_EQ(Returned("python3 -B " + folder + "/effects.py --test"), 0);
  EXPECT_EQ(
      Returned("cc -std=c99 -pedantic -Wall -Wextra -Werror -DEFFECTS_TEST "
               "-o " +
               folder + "/test " + folder + "/effects.c -lm && " + folder +
               "/test"),
      0);
}

// Some joint of which a random one is in `effect`.
int JointFor(const Effect& effect, MovedArm* moved) {
  for (int tried = 0; tried < 20; ++tried) {
    const int j = static_cast<int>(moved->random() % 3);
    if (moved->Fits(effect, j)) return j;
  }
  return 0;
}

class ModulesOf : public testing::TestWithParam<Effect> {};

TEST_P(ModulesOf, DoAsTheLawDoes) {
  MovedArm moved;
  moved.random.seed(std::hash<std::string>()(GetParam().name));
  const bool whole = GetParam().scope == Effect::Scope::kRobot;
  const int joint = whole ? -1 : JointFor(GetParam(), &moved);
  Agree(moved.With({moved.Drawn(GetParam(), joint)}), GetParam().name);
}

std::vector<Effect> Held() {
  std::vector<Effect> held;
  std::copy_if(Effects().begin(), Effects().end(), std::back_inserter(held),
               [](const Effect& effect) { return bool(effect.numbers); });
  return held;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ModulesOf, testing::ValuesIn(Held()),
                         [](const auto& info) { return info.param.name; });

// Every law of a joint's torque, transmission, command or encoder: what changes
// the rigid robot, a push at a point of it and the clock of a log is elsewhere.
TEST(Modules, HoldAllButTheseLaws) {
  std::vector<std::string> others;
  for (const Effect& effect : Effects()) {
    if (!effect.numbers) others.push_back(effect.name);
  }
  EXPECT_THAT(others,
              ElementsAre("armature", "torque_gain_of_all_joints",
                          "link_length", "base_tilt", "payload", "added_mass",
                          "link_inertia", "viscous_friction_of_all_joints",
                          "external_contact", "time_base"));
}

// One joint has a spring, and all others at once whatever fits; commands lag.
TEST(Modules, HoldManyLawsTogether) {
  MovedArm moved;
  std::vector<GapCandidate> effects;
  bool yields = false;
  for (const Effect& effect : Effects()) {
    if (!effect.numbers || effect.scope == Effect::Scope::kRobot) continue;
    const bool spring = !effect.proportional && effect.larger_sizes.size() > 0;
    if (spring && yields) continue;
    yields = yields || spring;
    effects.push_back(moved.Drawn(effect, JointFor(effect, &moved)));
  }
  EXPECT_GT(effects.size(), 20u);
  Agree(moved.With(effects, -.004), "together");
}

// Whether both languages say the same beside a robot file, and what the file
// has to have in their stead.
void LeaveTheirPart(const std::string& folder, const std::string& format,
                    const std::string& bit) {
  const std::string here = TESTS_DIR "/calib/diagnose/modules/beside";
  EXPECT_EQ(Returned("python3 -B " + here + ".py " + folder + " " + format +
                     " > " + folder + "/python.txt"),
            0);
  EXPECT_EQ(
      Returned("cc -std=c99 -DBESIDE=" + bit + " -I" + folder + " -o " +
               folder + "/beside " + here + ".c " + folder +
               "/effects.c -lm && " + folder + "/beside > " + folder +
               "/c.txt && cmp " + folder + "/c.txt " + folder + "/python.txt"),
      0);
}

// A spring is in plain MJCF, of bristles, warm friction and a drift their
// share, all else in the module.
TEST(Modules, LeaveRobotFilesTheirPart) {
  MovedArm moved;
  LeaveTheirPart(
      Written(moved.With({moved.Drawn(*FindEffect("spring"), 0),
                          moved.Drawn(*FindEffect("presliding"), 1),
                          moved.Drawn(*FindEffect("stribeck"), 0),
                          moved.Drawn(*FindEffect("thermal_friction"), 0),
                          moved.Drawn(*FindEffect("time_drift"), 2),
                          moved.Drawn(*FindEffect("torque_gain"), 1),
                          moved.Drawn(*FindEffect("torque_ripple"), 2)}),
              "beside"),
      "mjcf_plain", "EFFECTS_IN_MJCF_PLAIN");
}

// MJCF has bristles and ripple, and torque that acts late.
TEST(Modules, LeaveMjcfItsLaws) {
  MovedArm moved;
  const std::vector<GapCandidate> effects = {
      moved.Drawn(*FindEffect("presliding"), 1),
      moved.Drawn(*FindEffect("position_friction"), 0),
      moved.Drawn(*FindEffect("thermal_friction"), 2),
      moved.Drawn(*FindEffect("time_drift"), 1),
      moved.Drawn(*FindEffect("torque_ripple"), 2)};
  LeaveTheirPart(Written(moved.With(effects), "beside_laws"), "mjcf",
                 "EFFECTS_IN_MJCF");
  LeaveTheirPart(Written(moved.With(effects, -.004), "beside_late"), "mjcf",
                 "EFFECTS_IN_MJCF");
}

TEST(Modules, SayWhatTheyLack) {
  MovedArm moved;
  const auto losses = [&](const std::string& name, int joint) {
    const CorrectedRobot robot =
        moved.With({moved.Drawn(*FindEffect(name), joint)});
    return MakeEffectModules(robot, {"c"})[0].losses;
  };
  EXPECT_THAT(losses("stribeck", 0), IsEmpty());
  EXPECT_THAT(losses("payload", -1), IsEmpty());
  EXPECT_THAT(losses("delay", -1), IsEmpty());
  EXPECT_THAT(losses("external_contact", -1),
              ElementsAre("the module has no law for external_contact"));
  EXPECT_THAT(losses("elasticity", 1),
              Contains(HasSubstr("to have no armature, damping")));
  EXPECT_THAT(MakeEffectModules(moved.With({}, 3e-3), {"c"})[0].losses,
              Contains(HasSubstr("3 ms after they acted")));
}

}  // namespace armcal::modules_test
