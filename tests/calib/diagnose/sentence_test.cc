#include "calib/diagnose/sentence.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::sentence_test {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(BriefReport, NamesWhatIsMissingAndHowMuchItMatters) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks stribeck on elbow and payload, which removes 93 % "
            "of the gap that refitting leaves on held-out data.");
  diagnosis.effects.push_back(MakeFound("torque_ripple", 0));
  diagnosis.verdict = GapVerdict::kPartlyExplained;
  diagnosis.torque.removed_percent = std::nan("");
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks stribeck on elbow, payload and torque ripple on "
            "shoulder; something else is left.");
}

// Words are no surer than the probability, and no shrinking is claimed where
// there is none.
TEST(BriefReport, SaysHowSureItIs) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.resize(1);
  diagnosis.effects[0].probability = .6;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("probably lacks stribeck"));
  diagnosis.torque.removed_percent = -47;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model probably lacks stribeck on elbow, too small a part of "
            "the gap for held-out data to show.");
  diagnosis.effects[0].gain = {-1, 1, {-2, .5}};
  EXPECT_EQ(BriefReport(diagnosis),
            "The model probably lacks stribeck on elbow, which does not shrink "
            "the gap on held-out data.");
  diagnosis.effects[0].probability = .5;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("may lack stribeck"));
}

// What the file gives no joint is in the refit, too: the file's gap is what it
// shrinks.
TEST(BriefReport, ComparesTermsThatAFileLacksWithTheFile) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects = {MakeFound("coulomb_friction", -1)};
  diagnosis.effects[0].fitted.clear();
  diagnosis.torque.removed_percent = 0;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks coulomb friction; refitted with it, 95 % of the "
            "file's gap is gone on held-out data.");
}

// Both at once: a refit has the terms, and how far it comes is told of them
// alone.
TEST(BriefReport, TellsWhatTermsAndWhatOtherEffectsRemove) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects = {MakeFound("delay", -1),
                       MakeFound("coulomb_friction", -1),
                       MakeFound("armature", -1)};
  for (size_t k : {1, 2}) diagnosis.effects[k].fitted.clear();
  diagnosis.effects[0].probability = .6;
  diagnosis.torque.refit_removes_percent = 80;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks coulomb friction and armature; refitted with "
            "them, 80 % of the file's gap is gone on held-out data; it also "
            "probably lacks delay, which removes 93 % of the gap that "
            "refitting leaves on held-out data.");
}

TEST(BriefReport, SaysHowMuchEffectsLeaveThatRemoveMostOfIt) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.torque.after = 16;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("leaves on held-out data; 16 times the noise's mean "
                        "square is left."));
  diagnosis.torque.after = 1.9;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("on held-out data."));
}

TEST(BriefReport, SaysWhatItCannotName) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kUnknown;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("no known effect explains: most of it on elbow, "
                        "ordered by its time."));
  diagnosis.unexplained = {};
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("no known effect explains."));
  const std::vector<std::pair<GapVerdict, std::string>> others = {
      {GapVerdict::kNoiseFloor, "agrees with the log to within what"},
      {GapVerdict::kAbsorbed, "better values"},
      {GapVerdict::kNotTestable, "cannot carry a diagnosis"}};
  diagnosis.torque.refit = 1;
  for (const auto& [verdict, text] : others) {
    diagnosis.verdict = verdict;
    EXPECT_THAT(BriefReport(diagnosis), HasSubstr(text));
  }
}

// Something real that known effects explain is not said to have no explanation.
TEST(BriefReport, NamesAFewTogetherThatItCannotTellApart) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kUnknown;
  FoundEffect offset = MakeFound("encoder_offset", 1);
  offset.any_probability = .7;
  offset.equivalent = {{FindEffect("base_tilt"), -1, .3},
                       {FindEffect("encoder_offset"), 0, .1}};
  diagnosis.unnamed = {MakeFound("spring", 0), offset};
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("no known effect explains"));
  diagnosis.unnamed[1].one_of_few = true;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model probably lacks one of encoder offset on elbow, base "
            "tilt and encoder offset on shoulder: these data cannot tell "
            "which.");
}

// Noise of .77 N m agrees with a pendulum of 1 N m, loaded or not.
TEST(BriefReport, SaysWithinWhatItAgrees) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kNoiseFloor;
  diagnosis.torque.refit = 1;
  diagnosis.joints.resize(2);
  diagnosis.joints[0].name = "shoulder";
  diagnosis.joints[1].name = "elbow";
  diagnosis.joints[0].floor_rms = .1;
  diagnosis.joints[0].torque_rms = 10;
  diagnosis.joints[1].floor_rms = .77;
  diagnosis.joints[1].torque_rms = 1;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model agrees with the log to within what a refit leaves, "
            "which is taken for noise and is up to 77 % of the torque of "
            "elbow.");
  diagnosis.joints[1].floor_rms = 1.1;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("explains less of the torque"))
      << "a half and more of the squares, in the joints' mean";
  diagnosis.verdict = GapVerdict::kAbsorbed;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("explains less of the torque"));
  diagnosis.verdict = GapVerdict::kNoiseFloor;
  diagnosis.floor = NoiseFloor::kStandstill;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model agrees with the log to within the noise, which is as "
            "large as the torque of elbow: that tells nothing of it.");
}

// That friction and timing changed and nothing else is more than a refit says:
// it may have taken up an encoder's offset.
TEST(BriefReport, TellsWhatARefitSinceAReferenceDoes) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kAbsorbed;
  diagnosis.torque.nominal = 25.9;
  diagnosis.torque.refit = 1.44;
  diagnosis.moved.clear();
  const std::string refit =
      "refitting the model's numbers (friction, links, timing) brings "
      "what is left of held-out torque from 25.9 to 1.4 times the noise's mean "
      "square";
  EXPECT_EQ(BriefReport(diagnosis),
            "No change since the reference is named, yet " + refit +
                ": something has changed, or shows in this motion alone.");
  diagnosis.moved = {
      {"elbow.viscous", "N m s/rad", 10, 8, .1, -2, JointTerm::kViscous}};
  EXPECT_EQ(BriefReport(diagnosis),
            "Friction has changed since the reference: elbow.viscous -20 %. "
            "Nothing else is named: " +
                refit + "; a change that is like these may hide in that.");
}

// Of friction that was below zero a share has the wrong sign: it is told how
// much it changed by.
TEST(BriefReport, TellsNoShareOfFrictionBelowZero) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kAbsorbed;
  diagnosis.moved = {
      {"elbow.coulomb", "N m", -.059, .48, .01, 9, JointTerm::kCoulomb},
      {"elbow.viscous", "N m s/rad", -.054, -.006, .01, 3,
       JointTerm::kViscous}};
  EXPECT_THAT(BriefReport(diagnosis),
              StartsWith("Friction has changed since the reference: "
                         "elbow.coulomb +0.54 N m, elbow.viscous +0.048 N m "
                         "s/rad. "));
}

// Held out, a robot as it was is left with little more than the noise, even
// where what was fitted had a trace of something; only what is left there may
// have changed.
TEST(BriefReport, SaysWhatHasChangedWithoutAName) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.moved.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kUnknown;
  diagnosis.torque.after = 1.9;
  EXPECT_EQ(BriefReport(diagnosis),
            "No change since the reference can be named; what is left of "
            "held-out torque is 1.9 times the noise's mean square: most of it "
            "on elbow, ordered by its time.");
  diagnosis.torque.after = 2.3;
  EXPECT_EQ(BriefReport(diagnosis),
            "Something has changed since the reference that no known effect "
            "explains, or shows in this motion alone: most of it on elbow, "
            "ordered by its time.");
  diagnosis.moved = {
      {"elbow.viscous", "N m s/rad", 10, 8, .1, -2, JointTerm::kViscous}};
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr(" -20 %. Something else has"));
  diagnosis.torque.after = 1;
  diagnosis.unexplained = {};
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr(" -20 %. No other change since the reference can be "
                        "named; what is left of held-out torque is the "
                        "noise."));
  FoundEffect few = MakeFound("encoder_offset", 1);
  few.any_probability = .7;
  few.one_of_few = true;
  few.equivalent = {{FindEffect("base_tilt"), -1, .3}};
  diagnosis.unnamed = {few};
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("Probably changed since the reference: one of encoder "
                        "offset on elbow and base tilt; these data cannot tell "
                        "which."));
}

// Whatever the verdict.
TEST(BriefReport, SaysFirstWhatFrictionHasChanged) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.has_reference = true;
  diagnosis.moved = {
      {"elbow.viscous", "N m s/rad", 10, 8, .1, -2, JointTerm::kViscous},
      {"wrist.coulomb", "N m", 1e-9, .25, .01, 1, JointTerm::kCoulomb}};
  const std::string said =
      "Friction has changed since the reference: elbow.viscous -20 %, "
      "wrist.coulomb +0.25 N m. ";
  EXPECT_EQ(BriefReport(diagnosis).rfind(said, 0), 0u)
      << BriefReport(diagnosis);
  diagnosis.effects.clear();
  diagnosis.torque.refit = 1;
  diagnosis.verdict = GapVerdict::kAbsorbed;
  EXPECT_EQ(BriefReport(diagnosis).rfind(said, 0), 0u);
  // Against a file it is the file that is wrong.
  diagnosis.has_reference = false;
  EXPECT_THAT(BriefReport(diagnosis), Not(HasSubstr("Friction has changed")));
}

TEST(BriefReport, SaysZerosOfTorquesApart) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.has_reference = true;
  diagnosis.verdict = GapVerdict::kAbsorbed;
  diagnosis.torque.refit = 1;
  diagnosis.moved = {
      {"elbow.offset", "N m", -.01, .09, .01, 2, JointTerm::kOffset},
      {"elbow.viscous", "N m s/rad", 10, 8, .1, -2, JointTerm::kViscous},
      {"wrist.offset", "N m", 0, -.25, .01, -1, JointTerm::kOffset}};
  EXPECT_EQ(BriefReport(diagnosis),
            "Friction has changed since the reference: elbow.viscous -20 %. "
            "Torques' zeros have moved since the reference: elbow.offset +0.1 "
            "N m, wrist.offset -0.25 N m. Nothing else is named: refitting the "
            "model's numbers (friction, links, timing) brings what is left of "
            "held-out torque from 12 times the noise's mean square to the "
            "noise; a change that is like these may hide in that.");
}

TEST(BriefReport, DoesNotCallItNoiseWhereMoreIsLeft) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kUnknown;
  diagnosis.torque.refit = 49;
  diagnosis.only_held_out_left = true;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("off by 49 times"));
  diagnosis.only_held_out_left = false;
  EXPECT_THAT(BriefReport(diagnosis), Not(HasSubstr("off by")));
}

// How far a refit comes is said as it is: to the noise, or near it.
TEST(BriefReport, SaysHowFarARefitComes) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kAbsorbed;
  diagnosis.torque.refit = 1.04;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("down to the noise."));
  diagnosis.torque.refit = 1.83;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("down to 1.8 times the noise's mean square."));
}

}  // namespace armcal::sentence_test
