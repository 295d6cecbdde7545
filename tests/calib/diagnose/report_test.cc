#include "calib/diagnose/report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "calib/diagnose/sentence.h"
#include "tests/calib/diagnose/sample_diagnosis.h"

namespace armcal::report_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// A list that is longer than a screen is wide goes on below.
TEST(FullReport, WrapsLongListsOfEstimates) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.resize(1);
  FoundEffect& found = diagnosis.effects[0];
  found.estimates.assign(7, {"shoulder.coulomb", "N m", 1.25});
  found.stddev.assign(7, .1);
  const std::string report = FullReport(diagnosis, false);
  EXPECT_THAT(report, HasSubstr("shoulder.coulomb 1.25 +- 0.1 N m,\n"
                                "         shoulder.coulomb 1.25 +- 0.1 N m,"));
}

// Those whose 95 % interval holds 0; of a single effect's numbers each stays.
TEST(FullReport, NumbersOfJointsThatTheMotionDoesNotTellAreNamedApart) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.resize(1);
  FoundEffect& found = diagnosis.effects[0];
  found.estimates = {{"shoulder.viscous", "N m s/rad", .6},
                     {"elbow.viscous", "N m s/rad", 3.8},
                     {"wrist.viscous", "N m s/rad", -.3}};
  found.stddev = {.1, 20, .2};
  const std::string all =
      "shoulder.viscous 0.6 +- 0.1 N m s/rad,\n"
      "         elbow.viscous 3.8 +- 2e+01 N m s/rad";
  EXPECT_THAT(FullReport(diagnosis, false), HasSubstr(all));
  found.missing_term = JointTerm::kViscous;
  EXPECT_THAT(FullReport(diagnosis, false),
              HasSubstr("shoulder.viscous 0.6 +- 0.1 N m s/rad\n"
                        "         not told by this motion: elbow.viscous, "
                        "wrist.viscous\n"));
  found.stddev[0] = 1;  // none is told: all are shown
  EXPECT_THAT(FullReport(diagnosis, false), Not(HasSubstr("not told by")));
  EXPECT_EQ(ToJson(diagnosis)["effects"][0]["estimates"].size(), 3u);
}

TEST(Reports, ListContacts) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects.resize(1);
  diagnosis.effects.push_back(MakeTouched());
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("Something touched the arm 2 times; the model lacks "
                        "stribeck on elbow, which removes 93 %"));
  EXPECT_THAT(FullReport(diagnosis, true),
              HasSubstr("         1.0 to 2.5 s: -40 +- 2 N m on elbow\n"));
  diagnosis.effects = {MakeTouched()};
  EXPECT_EQ(BriefReport(diagnosis), "Something touched the arm 2 times.");
  const json effect = ToJson(diagnosis)["effects"][0];
  EXPECT_EQ(effect["time_windows"][1][1], 2.5);
  EXPECT_EQ(effect["contacts"][1]["torque"][1], -40);
  EXPECT_EQ(effect["contacts"][1]["joint"], "elbow");
  EXPECT_TRUE(effect["contacts"][1]["force"].is_null());
}

// What helps to predict the reference, and is within its deviation.
TEST(FullReport, GivesValuesOfSignificantLawsAlone) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.shown = {
      {FindEffect("stribeck"), 1, {{"size", "N m", 2}}, {.1}, true},
      {FindEffect("torque_ripple"), 0, {{"size", "N m", 2}}, {3}, false}};
  EXPECT_THAT(FullReport(diagnosis, false),
              HasSubstr("\nthe reference itself shows\n"
                        "  stribeck on elbow: size 2 +- 0.1 N m\n"
                        "  laws whose sizes it does not tell: torque ripple on "
                        "shoulder\n"));
  const json shown = ToJson(diagnosis)["reference_shows"];
  EXPECT_EQ(shown[0]["significant"], true);
  EXPECT_EQ(shown[1]["significant"], false);
}

TEST(FullReport, WhatNothingTellsOfIsNotSeen) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.effects[0].estimates = {
      {"mass", "kg", .5}, {"com_z", "m", 0}, {"harmonic", "1", 2}};
  diagnosis.effects[0].stddev = {.01, 0, 0};
  EXPECT_THAT(FullReport(diagnosis, true),
              HasSubstr("mass 0.5 +- 0.01 kg, com_z not seen, harmonic 2\n"));
  const json estimates = ToJson(diagnosis)["effects"][0]["estimates"];
  EXPECT_TRUE(estimates[1]["value"].is_null());
  EXPECT_TRUE(estimates[1]["stddev"].is_null());
  EXPECT_EQ(estimates[2]["value"], 2);
  EXPECT_TRUE(estimates[2]["stddev"].is_null());
}

TEST(FullReport, HoldsEveryPart) {
  const std::string text = FullReport(SampleDiagnosis(), true);
  for (const char* part :
       {"stribeck on elbow: size 1.25 +- 0.04 N m, share 0.5 +- 0.01\n",
        "or 8 % presliding on elbow", "told apart by: constant velocities",
        "forearm.mass", "backlash: the load never reverses (elbow)",
        "currents: no torque column (`torque_constants`)", "removed 93 %",
        "noise told from: assumed"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(FullReport, ListsWhatItCannotTellApart) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.unnamed = {diagnosis.effects[0]};
  diagnosis.effects.clear();
  EXPECT_THAT(FullReport(diagnosis, true), Not(HasSubstr("or 8 %")));
  diagnosis.unnamed[0].one_of_few = true;
  EXPECT_THAT(
      FullReport(diagnosis, true),
      HasSubstr("stribeck on elbow: would remove 40 % of what refitting "
                "leaves\n         or 8 % presliding on elbow\n"));
  EXPECT_TRUE(ToJson(diagnosis)["fitted_not_named"][0]["one_of_few"]);
}

// Where joints have a delay each, what looks so is said, and what they have.
TEST(FullReport, SaysWhereJointsDisagree) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  FoundEffect delay = diagnosis.effects[0];
  delay.effect = FindEffect("delay");
  delay.joint = -1;
  delay.estimates = {{"delay", "s", .004}};
  delay.stddev = {.001};
  delay.joint_sizes = {{0, .012, .001}, {1, -.001, .002}};
  diagnosis.unnamed = {delay};
  EXPECT_THAT(
      FullReport(diagnosis, true),
      HasSubstr("\n         its joints disagree: " + diagnosis.joints[0].name +
                " 0.012 +- 0.001 s, " + diagnosis.joints[1].name +
                " -0.001 +- 0.002 s\n         which may be friction "
                "that lags at reversals"));
  const nlohmann::json unnamed = ToJson(diagnosis)["fitted_not_named"][0];
  EXPECT_EQ(unnamed["joint_sizes"][1]["joint_index"], 2);
  EXPECT_EQ(unnamed["joint_sizes"][0]["value"], .012);
  diagnosis.unnamed[0].joint_sizes.clear();
  EXPECT_THAT(FullReport(diagnosis, true), Not(HasSubstr("disagree")));
}

TEST(FullReport, SaysWhereNothingWasHeldOut) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.torque = {};
  diagnosis.joints[0].refit_rms = std::nan("");
  const std::string text = FullReport(diagnosis, true);
  EXPECT_THAT(text, HasSubstr("nothing was held out"));
  EXPECT_THAT(text, HasSubstr("         -"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_TRUE(ToJson(diagnosis)["gap"]["torque"]["after"].is_null());
}

TEST(FullReport, LeavesOutWhatThereIsNot) {
  GapDiagnosis diagnosis;
  const std::string text = FullReport(diagnosis, true);
  for (const char* part :
       {"which effect", "far from the file", "note ", "not testable", "nan"}) {
    EXPECT_THAT(text, Not(HasSubstr(part)));
  }
}

// Effects that the same joints hide for the same reason stand in one line.
TEST(FullReport, GathersWhatIsNotTestable) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.untestable = {{"delay", "", "noise"},
                          {"spring", "elbow", "noise"},
                          {"spring", "wrist", "noise"},
                          {"spring", "hand", "it rests"}};
  EXPECT_THAT(FullReport(diagnosis, true),
              HasSubstr("  delay: noise\n  spring: noise (elbow, wrist)\n"
                        "  spring: it rests (hand)\n"));
}

// What many joints and effects have is a line, so that the answer stays on the
// screen, unless asked for.
TEST(FullReport, CountsWhatIsNotTestable) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.untestable.clear();
  for (const char* effect : {"delay", "spring", "cable", "stribeck"}) {
    diagnosis.untestable.push_back({effect, "elbow", "noise"});
    diagnosis.untestable.push_back({effect, "hand", "it rests"});
  }
  EXPECT_THAT(FullReport(diagnosis, false),
              HasSubstr("not testable on these data, on some joints or all: 4 "
                        "effects (`verbose`: which, and why)\n"));
  EXPECT_THAT(FullReport(diagnosis, false), Not(HasSubstr("it rests")));
  EXPECT_THAT(FullReport(diagnosis, true), HasSubstr("  spring: it rests"));
  diagnosis.untestable.resize(5);
  EXPECT_THAT(FullReport(diagnosis, false), HasSubstr("  spring: it rests"));
}

// Type by type, the keys of diagnosis.json (docs/diagnose.md).
void ExpectKeys(const json& object, const std::string& numbers,
                const std::string& strings, const std::string& arrays) {
  const auto expect = [&](const std::string& keys, auto is) {
    std::istringstream all(keys);
    for (std::string key; all >> key;) {
      ASSERT_TRUE(object.contains(key)) << key << " of " << object;
      EXPECT_TRUE(is(object[key])) << key << ": " << object[key];
    }
  };
  expect(numbers, [](const json& x) { return x.is_number(); });
  expect(strings, [](const json& x) { return x.is_string(); });
  expect(arrays, [](const json& x) { return x.is_array(); });
}

TEST(DiagnosisJson, HasTheDesignsKeys) {
  const json all = ToJson(SampleDiagnosis());
  ExpectKeys(all, "bandwidth_hz", "verdict sentence floor_source",
             "data effects candidates untestable absorbed");
  ExpectKeys(all["data"][0], "", "finding evidence flag", "");
  const json& effect = all["effects"][0];
  ExpectKeys(effect, "joint_index probability removed_percent",
             "effect joint separate_by",
             "estimates equivalent ci95 time_windows");
  ExpectKeys(effect["estimates"][0], "value stddev", "name unit", "");
  ExpectKeys(effect["equivalent"][0], "joint_index", "effect", "");
  ExpectKeys(all["candidates"][0], "joint_index probability", "effect", "");
  ExpectKeys(all["where"]["joints"][0],
             "nominal_rms refit_rms after_rms floor_rms", "name organised_by",
             "");
  ExpectKeys(all["untestable"][0], "", "effect joint why", "");
  ExpectKeys(all["gap"]["torque"],
             "nominal refit after floor removed_percent "
             "removed_from_nominal_percent",
             "", "ci95");
  ExpectKeys(all["unexplained"], "share", "joint organised_by", "");
  ExpectKeys(all["absorbed"][0], "nominal value stddev", "name unit", "");
}

TEST(DiagnosisJson, HasTheValues) {
  const json all = ToJson(SampleDiagnosis());
  EXPECT_EQ(all["verdict"], "explained");
  EXPECT_EQ(all["effects"][0]["effect"], "stribeck");
  EXPECT_EQ(all["effects"][0]["joint"], "elbow");
  EXPECT_EQ(all["effects"][0]["joint_index"], 2);
  EXPECT_EQ(all["effects"][1]["joint"], "");
  EXPECT_EQ(all["effects"][1]["joint_index"], 0);
  EXPECT_EQ(all["effects"][0]["estimates"][0]["stddev"], .04);
  EXPECT_EQ(all["absorbed"][0]["value"], 2.5);
  EXPECT_EQ(all["where"]["joints"][1]["name"], "elbow");
}

// Nothing can be removed: no number, and still JSON.
TEST(DiagnosisJson, WhatIsNotANumberIsNull) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  diagnosis.torque.removed_percent = std::nan("");
  const json all = json::parse(ToJson(diagnosis).dump());
  EXPECT_TRUE(all["gap"]["torque"]["removed_percent"].is_null());
}

TEST(GapVerdict, HasTheDesignsNames) {
  std::vector<std::string> names;
  for (int k = 0; k < 6; ++k) {
    names.push_back(GapVerdictName(static_cast<GapVerdict>(k)));
  }
  EXPECT_THAT(names, testing::ElementsAre("noise_floor", "absorbed",
                                          "explained", "partly_explained",
                                          "unknown", "not_testable"));
}

TEST(FullReport, SaysWhatDiverges) {
  GapDiagnosis diagnosis = SampleDiagnosis();
  const double infinite = std::numeric_limits<double>::infinity();
  diagnosis.torque.refit = infinite;
  diagnosis.forward.emplace();
  diagnosis.forward->has_figures = true;
  diagnosis.forward->figures = diagnosis.torque;
  diagnosis.forward->figures.nominal = NAN;
  const std::string text = FullReport(diagnosis, false);
  EXPECT_THAT(text, HasSubstr("noise's: nominal 12, refitted diverges, with "
                              "the effects 1.5, noise 1"));
  EXPECT_THAT(text, HasSubstr("nominal -, refitted diverges"));
}

}  // namespace armcal::report_test
