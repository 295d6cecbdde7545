// What a diagnosis of poses claims, by how probable it is.

#include <gmock/gmock.h>

#include <algorithm>

#include "calib/poses/diagnosis/report.h"
#include "calib/poses/diagnosis/settled_rivals.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::pose_sentence_test {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const PoseEffect& Effect(const std::string& name) {
  const auto& effects = PoseEffects();
  return *std::find_if(effects.begin(), effects.end(),
                       [&](const auto& e) { return e.name == name; });
}

PoseFinding Found(const std::string& effect, const std::string& where,
                  double probability, double none) {
  PoseFinding finding;
  finding.placed = {&Effect(effect), {}};
  finding.name = effect + where;
  finding.probability = probability;
  finding.none = none;
  finding.displacement_rms = 2e-3;
  return finding;
}

PoseFinding Few() {
  PoseFinding few = Found("joint_step", " of wrist", .4, .05);
  few.equivalents.push_back({few.placed, "joint_drift of wrist", .35, {}, 0});
  few.equivalents.push_back({few.placed, "tool_step", .2, {}, 0});
  return few;
}

std::string Sentence(const std::vector<PoseFinding>& findings) {
  PoseDiagnosis diagnosis;
  diagnosis.verdict = PoseVerdict::kExplained;
  diagnosis.findings = findings;
  diagnosis.gap.held_out_geometry = 4e-3;
  diagnosis.gap.held_out_after = 3e-3;
  return PoseSentence(diagnosis);
}

TEST(PoseSentence, LacksWhatIsLikelierThanAllElse) {
  EXPECT_EQ(
      Sentence({Found("joint_sag", " of elbow", .9, .01)}),
      "The geometry lacks joint_sag of elbow (2 mm rms). Held-out poses are "
      "then 3 mm rms away instead of 4 mm.");
  EXPECT_THAT(Sentence({Found("joint_sag", " of elbow", .6, .3)}),
              StartsWith("The geometry probably lacks joint_sag of elbow (2 mm "
                         "rms). Held-out"));
}

// A ratio of -1 within its interval is a sign.
TEST(PoseSentence, KnowsAJointThatCountsTheOtherWay) {
  PoseFinding turned = Found("gear_ratio", " of elbow", 1, 0);
  turned.amounts.push_back({"k", "1", -2.0004, 5e-4});
  EXPECT_THAT(Sentence({turned}),
              StartsWith("The geometry lacks gear_ratio of elbow, which counts "
                         "the other way (2 mm rms)."));
  turned.amounts[0].value = -2.0006;
  EXPECT_THAT(Sentence({turned}),
              StartsWith("The geometry lacks gear_ratio of elbow (2 mm rms)."));
}

// What an arm has is to be corrected, what moved is to be measured again.
TEST(PoseSentence, TellsWhatTheArmHasFromWhatChanged) {
  EXPECT_THAT(
      Sentence({Found("tool_step", " from pose 86 on", 1, 0),
                Found("base_sag", "", .7, .1), Found("sag", "", 1, 0),
                Found("length_window", " of poses 29 to 504", .7, .1)}),
      StartsWith(
          "The geometry lacks sag (2 mm rms) and probably base_sag (2 mm rms). "
          "While the poses were measured something changed: tool_step "
          "from pose 86 on (2 mm rms) and probably length_window of poses "
          "29 to 504 (2 mm rms). Held-out"));
  EXPECT_THAT(Sentence({Found("frame_drift", "", 1, 0)}),
              StartsWith("While the poses were measured something changed: "
                         "frame_drift (2 mm rms). Held-out"));
  EXPECT_THAT(Sentence({Found("frame_drift", "", .7, .1)}),
              StartsWith("While the poses were measured something probably "
                         "changed: frame_drift (2 mm rms)."));
}

TEST(PoseSentence, NamesAFewWhereNoneOfThemIsLikelier) {
  const std::string few =
      "These poses cannot tell which, but they show one of joint_step of wrist "
      "(40 %), joint_drift of wrist (35 %) and tool_step (20 %). ";
  EXPECT_THAT(Sentence({Few()}), StartsWith(few + "Held-out poses"));
  EXPECT_THAT(
      Sentence({Found("joint_sag", " of elbow", .9, .01), Few()}),
      StartsWith("The geometry lacks joint_sag of elbow (2 mm rms). " + few));
}

TEST(PoseSentence, ClaimsNothingThatNoneIsLikelierThan) {
  std::vector<PoseRivals> rivals(2);
  EXPECT_EQ(LeastClaimed({}), -1);
  rivals[0].none = .3;
  rivals[1].none = .49;
  EXPECT_EQ(LeastClaimed(rivals), -1);
  rivals[1].none = .54;
  EXPECT_EQ(LeastClaimed(rivals), 1);
  rivals[0].none = .6;
  EXPECT_EQ(LeastClaimed(rivals), 0);
  PoseDiagnosis diagnosis;
  diagnosis.gap.held_out_after = 4e-3;
  diagnosis.unlikely = {{"joint_step of wrist", .11, .54}};
  for (const auto verdict : {PoseVerdict::kNoiseFloor, PoseVerdict::kUnknown}) {
    diagnosis.verdict = verdict;
    EXPECT_THAT(PoseSentence(diagnosis), Not(HasSubstr("lacks")));
    EXPECT_THAT(PoseSentence(diagnosis),
                HasSubstr("The likeliest, joint_step of wrist (11 %), is less "
                          "likely than none (54 %)."));
  }
}

// What is left may be more than noise where nobody says how large that is.
TEST(PoseSentence, AsksForTheInstrument) {
  PoseDiagnosis diagnosis;
  diagnosis.verdict = PoseVerdict::kNoiseFloor;
  diagnosis.gap.held_out_after = 4e-3;
  EXPECT_EQ(PoseSentence(diagnosis),
            "The poses show no effect beyond the geometry, by which held-out "
            "poses are 4 mm rms away; the file states no uncertainty of the "
            "instrument (u95_1) to hold that against.");
  diagnosis.misfit.instrument_u95 = 2e-3;
  EXPECT_THAT(PoseSentence(diagnosis), Not(HasSubstr("u95")));
}

// By the rows of the file, as outliers are, or by its own numbers.
TEST(PoseSentence, CallsPosesAsTheFileDoes) {
  Plant plant("UR5 6R", 1);
  PoseMeasurements measured = plant.Measure(Instrument::kTargets, 30, kNoise);
  PosePlace place;
  place.begin = 18;
  const auto name = [&] {
    return PlacedName(Effect("frame_step"),
                      MakeCampaign({plant.nominal}, measured, measured.q),
                      place);
  };
  EXPECT_EQ(name(), "frame_step from row 20 on");
  for (int k = 0; k < 30; ++k) measured.number.push_back(100 + k);
  EXPECT_EQ(name(), "frame_step from pose 118 on");
  // Of no file: postures that are asked for.
  measured.number.clear();
  measured.row.clear();
  EXPECT_EQ(name(), "frame_step from row 19 on");
}

}  // namespace armcal::pose_sentence_test
