#include "calib/diagnose/named_effects.h"

#include <gmock/gmock.h>

#include "calib/diagnose/sentence.h"
#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::named_effects_test {

using testing::HasSubstr;

// With a reference the question is what has changed, and an effect is a change
// since it, with its direction: friction of -.08 N m is less, not lacking.
TEST(NamedEffects, TellsEffectsAsChangesSinceAReference) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.has_reference = true;
  diagnosis.moved.clear();
  FoundEffect friction = MakeFound("coulomb_friction", 1);
  friction.estimates = {{"coulomb", "N m", -.08}};
  diagnosis.effects = {MakeFound("payload", -1), friction};
  diagnosis.effects[0].estimates[0] = {"mass", "kg", 1.25};
  EXPECT_EQ(BriefReport(diagnosis),
            "Changed since the reference: payload (+1.2 kg) and less coulomb "
            "friction "
            "on elbow, which removes 93 % of the gap that refitting leaves on "
            "held-out data.");
  diagnosis.effects[1].estimates[0].value = .08;
  diagnosis.effects[1].probability = .6;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("Probably changed since the reference: payload "
                        "(+1.2 kg) and more coulomb friction on elbow, which"));
  diagnosis.effects[1].probability = .5;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("May have changed since the reference: payload"));
  diagnosis.effects.push_back(MakeTouched());
  diagnosis.verdict = GapVerdict::kPartlyExplained;
  EXPECT_THAT(BriefReport(diagnosis),
              testing::AllOf(HasSubstr("Something touched the arm 2 times. May "
                                       "have changed since the reference: "),
                             testing::EndsWith("; something else is left.")));
}

TEST(NamedEffects, SaysWhereAReferenceDoesNotTellWhetherItHadALaw) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.has_reference = true;
  diagnosis.moved.clear();
  FoundEffect spring = MakeFound("spring", 1);
  spring.fitted = {0};
  diagnosis.effects = {spring};
  EXPECT_THAT(BriefReport(diagnosis),
              testing::EndsWith("on held-out data; the reference does not tell "
                                "whether the robot had spring on elbow "
                                "before."));
  diagnosis.effects[0].in_reference = {0, 400};
  EXPECT_THAT(BriefReport(diagnosis), testing::EndsWith("on held-out data."));
  // A load is of the day.
  diagnosis.effects = {MakeFound("payload", -1)};
  diagnosis.effects[0].fitted = {0};
  EXPECT_THAT(BriefReport(diagnosis), testing::EndsWith("on held-out data."));
}

// What is one of two is there beside what is named.
TEST(AlikeBesides, StandsBehindWhatIsNamed) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.unnamed = {MakeFound("torque_gain", 1)};
  const std::string named = BriefReport(diagnosis);
  diagnosis.unnamed[0].one_of_few = true;
  diagnosis.unnamed[0].any_probability = .7;
  diagnosis.unnamed[0].equivalent = {{FindEffect("spring"), 1, .2}};
  EXPECT_EQ(
      BriefReport(diagnosis),
      named +
          " Besides, the model probably lacks one of torque gain on elbow "
          "and spring on elbow: these data cannot tell which.");
  diagnosis.has_reference = true;
  diagnosis.unnamed[0].any_probability = .9;
  EXPECT_THAT(BriefReport(diagnosis),
              testing::EndsWith(" Besides, one of torque gain on elbow and "
                                "spring on elbow has changed: these data "
                                "cannot tell which."));
  diagnosis.verdict = GapVerdict::kPartlyExplained;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("; something else is left. Besides, one of torque "));
}

TEST(NamedEffects, TellsTouchesAsSurelyAsTheyAreKnown) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects = {MakeTouched()};
  const std::pair<double, const char*> told[] = {
      {.97, "Something touched the arm 2 times"},
      {.6, "Something probably touched the arm 2 times"},
      {.5, "Something may have touched the arm 2 times"}};
  for (const auto& [probability, words] : told) {
    diagnosis.effects[0].probability = probability;
    EXPECT_THAT(BriefReport(diagnosis), HasSubstr(words));
  }
}

// A body that the file has and the robot lacks is told as one taken off.
TEST(NamedEffects, TellsWhatWasTakenOff) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects = {MakeFound("added_mass", 1)};
  diagnosis.effects[0].estimates[0] = {"mass", "kg", -1.25};
  EXPECT_THAT(
      BriefReport(diagnosis),
      HasSubstr("The model lacks added mass on elbow (-1.2 kg), which"));
}

// A calibration's own logs are a reference; where they have the effect as well
// the calibrated robot lacks it, and nothing is said to have changed.
TEST(NamedEffects, TellsEffectsAsChangesSinceACalibration) {
  using Logs = GapDiagnosis::CalibrationsLogs;
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.has_calibration = diagnosis.has_reference = true;
  diagnosis.calibrations_logs = Logs::kAreTheReference;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("Changed since the calibration: stribeck on elbow"));
  diagnosis.has_reference = false;
  for (const Logs logs : {Logs::kHaveItToo, Logs::kUnknown}) {
    diagnosis.calibrations_logs = logs;
    EXPECT_THAT(BriefReport(diagnosis), HasSubstr("The model lacks stribeck"));
  }
}

}  // namespace armcal::named_effects_test
