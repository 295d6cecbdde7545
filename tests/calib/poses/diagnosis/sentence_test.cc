// What a diagnosis of poses claims, by how probable it is.

#include <gmock/gmock.h>

#include "calib/poses/diagnosis/report.h"
#include "calib/poses/diagnosis/settled_rivals.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::pose_sentence_test {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

PoseFinding Found(const std::string& name, double probability, double none) {
  PoseFinding finding;
  finding.name = name;
  finding.probability = probability;
  finding.none = none;
  return finding;
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
  EXPECT_EQ(Sentence({Found("sag of elbow", .9, .01)}),
            "The geometry lacks sag of elbow: held-out poses are 3 mm rms away "
            "instead of 4 mm.");
  EXPECT_THAT(Sentence({Found("sag of elbow", .6, .3)}),
              StartsWith("The geometry probably lacks sag of elbow:"));
}

TEST(PoseSentence, NamesAFewWhereNoneOfThemIsLikelier) {
  PoseFinding few = Found("joint_step of wrist", .4, .05);
  few.equivalents.push_back({few.placed, "joint_drift of wrist", .35, {}, 0});
  few.equivalents.push_back({few.placed, "tool_step", .2, {}, 0});
  EXPECT_THAT(Sentence({few}),
              StartsWith("The geometry lacks one of joint_step of wrist, "
                         "joint_drift of wrist and tool_step, which these "
                         "poses cannot tell apart: held-out poses"));
  EXPECT_THAT(Sentence({Found("sag of elbow", .9, .01), few}),
              StartsWith("The geometry lacks sag of elbow; it lacks one of"));
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
    EXPECT_THAT(
        PoseSentence(diagnosis),
        HasSubstr("None is likelier (54 %) than joint_step of wrist (11 %)."));
  }
}

// By the rows of the file, as outliers are, or by its own numbers.
TEST(PoseSentence, CallsPosesAsTheFileDoes) {
  Plant plant("UR5 6R", 1);
  PoseMeasurements measured = plant.Measure(Instrument::kTargets, 30, kNoise);
  const auto& effects = PoseEffects();
  const auto step =
      std::find_if(effects.begin(), effects.end(),
                   [](const auto& e) { return e.name == "frame_step"; });
  ASSERT_NE(step, effects.end());
  PosePlace place;
  place.begin = 18;
  const auto name = [&] {
    return PlacedName(
        *step, MakeCampaign({plant.nominal}, measured, measured.q), place);
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
