#include "calib/diagnose/names.h"

#include <gtest/gtest.h>

#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::names_test {

// `value`: of the effect's first estimate.
std::string Told(const std::string& name, int joint, const std::string& unit,
                 double value) {
  FoundEffect found = MakeFound(name, joint);
  found.estimates[0] = {"size", unit, value};
  return ChangeOf(found, SampleDiagnosis());
}

TEST(ChangeOf, TellsMoreOrLessOfNumbersThatAnyRobotHas) {
  EXPECT_EQ(Told("viscous_friction", 1, "N m s/rad", .2),
            "more viscous friction on elbow");
  EXPECT_EQ(Told("viscous_friction", 1, "N m s/rad", -.2),
            "less viscous friction on elbow");
  EXPECT_EQ(Told("armature", 0, "kg m^2", -.1), "less armature on shoulder");
  EXPECT_EQ(Told("link_length", 0, "m", .01), "larger link length on shoulder");
  EXPECT_EQ(Told("link_inertia", 0, "1", -.1),
            "smaller link inertia on shoulder");
}

// Less of an offset would be one nearer to 0: its sign is told as such.
TEST(ChangeOf, TellsOtherSignsWithTheSize) {
  EXPECT_EQ(Told("torque_gain", 1, "1", -.0799),
            "torque gain on elbow (-0.08)");
  EXPECT_EQ(Told("encoder_offset", 1, "rad", .0175),
            "encoder offset on elbow (+0.018 rad)");
}

// Which of two signals is late, no sign says.
TEST(ChangeOf, TellsInWordsWhichWayADelayGoes) {
  EXPECT_EQ(Told("delay", -1, "s", -.02),
            "delay (the log has torque late by 0.02 s)");
  EXPECT_EQ(Told("delay", -1, "s", .0021),
            "delay (motors give the commanded torque late by 0.0021 s)");
}

// A mass on the last joint's axis is the same on the link before it.
TEST(NameOf, TellsWhereABodyMayBe) {
  FoundEffect found = MakeFound("added_mass", 1);
  EXPECT_EQ(NameOf(found, SampleDiagnosis()), "added mass on elbow");
  found.or_at = {{FindEffect("payload"), -1, .4},
                 {FindEffect("added_mass"), 0, .1}};
  EXPECT_EQ(NameOf(found, SampleDiagnosis()),
            "added mass on elbow or payload or added mass on shoulder");
  found.or_at.pop_back();
  found.estimates[0] = {"mass", "kg", .5};
  found.stddev = {.05};
  EXPECT_EQ(ChangeOf(found, SampleDiagnosis()),
            "added mass on elbow (+0.5 kg) or payload");
}

// A body was added or taken off where its mass is known to that much; joints
// may tell its moment alone.
TEST(ChangeOf, TellsBodiesWithTheirMass) {
  FoundEffect found = MakeFound("payload", -1);
  found.estimates[0] = {"mass", "kg", -.48};
  found.stddev = {.05};
  EXPECT_EQ(ChangeOf(found, SampleDiagnosis()), "payload (-0.48 kg)");
  EXPECT_TRUE(IsTakenOff(found));
  found.stddev = {.3};
  EXPECT_EQ(ChangeOf(found, SampleDiagnosis()), "payload");
  EXPECT_FALSE(IsTakenOff(found));
  found.effect = FindEffect("added_mass");
  found.joint = 1;
  found.estimates[0].value = 1.5;
  EXPECT_EQ(ChangeOf(found, SampleDiagnosis()),
            "added mass on elbow (+1.5 kg)");
  EXPECT_FALSE(IsTakenOff(found));
}

// A ripple is a sine and a cosine; a play cannot be negative. Nothing is said
// of what is not known either.
TEST(ChangeOf, TellsNoDirectionWhereThereIsNone) {
  EXPECT_EQ(Told("torque_ripple", 1, "N m", 1), "torque ripple on elbow");
  EXPECT_EQ(Told("backlash", 1, "rad", .01), "backlash on elbow");
  EXPECT_EQ(Told("coulomb_friction", 1, "N m", 0), "coulomb friction on elbow");
  FoundEffect found = MakeFound("coulomb_friction", 1);
  found.estimates.clear();
  EXPECT_EQ(ChangeOf(found, SampleDiagnosis()), "coulomb friction on elbow");
}

}  // namespace armcal::names_test
