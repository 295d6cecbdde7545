#include "calib/diagnose/next_steps.h"

#include <gmock/gmock.h>

#include "calib/diagnose/report.h"
#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::next_steps_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const char* const kExport =
    "for a simulator: `export` and `modules` write the robot with what it was "
    "found to have";

// What is certain needs no experiment; what others are like needs the one that
// tells them apart.
TEST(NextSteps, ExperimentsForWhatIsNotCertain) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(kExport));
  for (FoundEffect& found : diagnosis.effects) found.probability = .6;
  FoundEffect cable = MakeFound("cable", 0), faint = MakeFound("cable", 1);
  cable.probability = .3;
  faint.probability = .05;
  diagnosis.unnamed = {cable, faint};
  EXPECT_THAT(
      NextSteps(diagnosis),
      ElementsAre(
          "to tell stribeck on elbow from what is like it: constant velocities",
          "to be sure of payload: " + FindEffect("payload")->experiment,
          "to see whether it is cable on shoulder: " +
              FindEffect("cable")->experiment,
          kExport));
}

// A weak guess is one of many, and what removes little is not what the gap is.
TEST(NextSteps, NoneForGuessesAndTrifles) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  FoundEffect guess = MakeFound("cable", 0), trifle = MakeFound("cable", 1);
  guess.probability = .19;
  trifle.probability = .7;
  trifle.removed_percent = 1;
  diagnosis.unnamed = {guess, trifle};
  diagnosis.verdict = GapVerdict::kExplained;
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty());
  diagnosis.unnamed[0].probability = .2;
  diagnosis.unnamed[1].removed_percent = 30;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(HasSubstr("cable on shoulder"),
                                                HasSubstr("cable on elbow")))
      << "40 % are more than 30 %";
  diagnosis.unnamed[1].removed_percent = 50;
  EXPECT_THAT(
      NextSteps(diagnosis),
      ElementsAre(HasSubstr("cable on elbow"), HasSubstr("cable on shoulder")));
  diagnosis.unnamed[1].removed_percent = NAN;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(HasSubstr("cable on shoulder"),
                                                HasSubstr("cable on elbow")))
      << "what was not held out may be anything";
  diagnosis.unnamed[1].removed_percent = 22;
  diagnosis.torque.refit = 1.1;
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty())
      << "40 % of a tenth of the noise";
}

// Friction differs from log to log by itself, and one log does not tell by how
// much.
TEST(NextSteps, ASecondReferenceWhereFrictionIsNamed) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.has_reference = true;
  diagnosis.moved.clear();
  diagnosis.effects = {MakeFound("coulomb_friction", 1)};
  const auto second = HasSubstr("a second log of the robot as it was");
  diagnosis.reference_logs = 1;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(second, kExport));
  diagnosis.reference_logs = 2;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(kExport));
  diagnosis.reference_logs = 1;
  diagnosis.effects = {MakeFound("stribeck", 1)};
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(second, kExport));
  diagnosis.effects = {MakeFound("payload", -1)};
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(kExport));
  diagnosis.effects[0].probability = .6;
  diagnosis.unnamed.assign(9, MakeFound("spring", 0));
  diagnosis.moved = {
      {"elbow.offset", "N m", 0, 1, .1, 4, JointTerm::kOffset},
      {"elbow.viscous", "N m s/rad", 10, 8, .1, -1.9, JointTerm::kViscous}};
  EXPECT_THAT(NextSteps(diagnosis)[0], HasSubstr("to be sure of payload"));
  diagnosis.moved[1].deviations = -2.1;
  EXPECT_THAT(NextSteps(diagnosis),
              ElementsAre(second, HasSubstr("payload"),
                          HasSubstr("spring on shoulder"), kExport))
      << "three experiments at most";
}

// One of a few is claimed, another that is likelier by itself is not.
TEST(NextSteps, WhatTellsAFewApartIsBeforeWhatIsNotClaimed) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kUnknown;
  FoundEffect few = MakeFound("spring", 0);
  few.probability = .2;
  few.one_of_few = true;
  few.separate_by = "slow sweeps";
  diagnosis.unnamed = {MakeFound("cable", 1), few};
  EXPECT_THAT(NextSteps(diagnosis),
              ElementsAre("to tell spring on shoulder from what is like it: "
                          "slow sweeps",
                          HasSubstr("cable on elbow")));
}

TEST(NextSteps, FewExperiments) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kUnknown;
  diagnosis.unnamed.assign(9, MakeFound("spring", 0));
  EXPECT_EQ(NextSteps(diagnosis).size(), 3u);
}

// What is of a log or of a moment is nothing to simulate.
TEST(NextSteps, NoSimulatorForRecordingsAndTouches) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects = {MakeFound("delay", -1), MakeTouched()};
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty());
}

TEST(NextSteps, AReferenceOfThisMotionWhereItKnewOneThatIsSlower) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.joints[0].beyond_reference = 1.9;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(kExport));
  diagnosis.joints[1].beyond_reference = 9;
  EXPECT_THAT(NextSteps(diagnosis),
              ElementsAre(testing::AllOf(HasSubstr("as fast as this log"),
                                         HasSubstr(diagnosis.joints[1].name +
                                                   " may be 9 times as large")),
                          kExport));
}

TEST(NextSteps, WhereNothingIsNamed) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kUnknown;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(HasSubstr("`reference`")));
  diagnosis.has_reference = true;
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty());
  diagnosis.verdict = GapVerdict::kAbsorbed;
  EXPECT_THAT(NextSteps(diagnosis), ElementsAre(HasSubstr("excite")));
  diagnosis.has_reference = false;
  EXPECT_THAT(NextSteps(diagnosis),
              ElementsAre(HasSubstr("calibrate"), HasSubstr("excite")));
  diagnosis.verdict = GapVerdict::kNoiseFloor;
  diagnosis.untestable.clear();
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty());
  diagnosis.verdict = GapVerdict::kNotTestable;
  diagnosis.unnamed = {MakeFound("spring", 0)};
  EXPECT_THAT(NextSteps(diagnosis), IsEmpty());
}

TEST(NextSteps, EndTheTextAndAreInTheJson) {
  const GapDiagnosis diagnosis = SampleDiagnosis();
  EXPECT_THAT(FullReport(diagnosis, false),
              testing::EndsWith(std::string("\nnext\n  ") + kExport + "\n"));
  EXPECT_EQ(ToJson(diagnosis)["next"][0], kExport);
}

}  // namespace armcal::next_steps_test
