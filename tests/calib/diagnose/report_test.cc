#include "calib/diagnose/report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "model/effects/effects.h"

namespace armcal::report_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

FoundEffect Found(const std::string& name, int joint) {
  FoundEffect found;
  found.effect = FindEffect(name);
  found.joint = joint;
  found.probability = .9;
  found.estimates = {{"size", "N m", 1.25}, {"share", "1", .5}};
  found.stddev = {.04, .01};
  found.removed_percent = 40;
  return found;
}

// One of everything that a diagnosis can say.
GapDiagnosis Diagnosis() {
  GapDiagnosis diagnosis;
  for (const char* name : {"shoulder", "elbow"}) {
    JointGap joint;
    joint.name = name;
    joint.unit = "N m";
    joint.nominal_rms = 4;
    joint.refit_rms = 3;
    joint.after_rms = 1;
    joint.organised.by = "speed";
    diagnosis.joints.push_back(joint);
  }
  diagnosis.verdict = GapVerdict::kExplained;
  diagnosis.effects = {Found("stribeck", 1), Found("payload", -1)};
  FoundEffect& first = diagnosis.effects[0];
  first.equivalent = {{FindEffect("presliding"), 1, .08, 10}};
  first.separate_by = "constant velocities";
  diagnosis.candidates = {{first.effect, 1, .9, 30}};
  diagnosis.moved = {{"forearm.mass", "kg", 2, 2.5, .1, 3}};
  diagnosis.untestable = {{"backlash", "elbow", "the load never reverses"}};
  diagnosis.data = {{"currents", "no torque column", "`torque_constants`"}};
  diagnosis.torque.nominal = 12;
  diagnosis.torque.refit = 9;
  diagnosis.torque.after = 1.5;
  diagnosis.torque.removed_percent = 93.4;
  diagnosis.torque.removed_from_nominal_percent = 95;
  diagnosis.bandwidth_hz = 8;
  diagnosis.unexplained = {"elbow", "time", .1};
  return diagnosis;
}

TEST(BriefReport, NamesWhatIsMissingAndHowMuchItMatters) {
  GapDiagnosis diagnosis = Diagnosis();
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks stribeck on elbow and payload, which removes 93 % "
            "of the gap that refitting leaves on data not used for choosing.");
  diagnosis.effects.push_back(Found("torque_ripple", 0));
  diagnosis.verdict = GapVerdict::kPartlyExplained;
  diagnosis.torque.removed_percent = std::nan("");
  EXPECT_EQ(BriefReport(diagnosis),
            "The model lacks stribeck on elbow, payload and torque ripple on "
            "shoulder; something else is left.");
}

// Words are no surer than the probability, and no shrinking is claimed where
// there is none.
TEST(BriefReport, SaysHowSureItIs) {
  GapDiagnosis diagnosis = Diagnosis();
  diagnosis.effects.resize(1);
  diagnosis.effects[0].probability = .6;
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("probably lacks stribeck"));
  diagnosis.effects[0].probability = .3;
  diagnosis.torque.removed_percent = -47;
  EXPECT_EQ(BriefReport(diagnosis),
            "The model may lack stribeck on elbow, which does not shrink the "
            "gap on data not used for choosing.");
}

FoundEffect Touched() {
  FoundEffect found = Found("external_contact", -1);
  Contact contact;
  contact.window = {1, 2.5};
  contact.time = 1.5;
  contact.joint = 1;
  contact.torque = Eigen::Vector2d(3, -40);
  contact.stddev = Eigen::Vector2d(.5, 2);
  found.contacts = {contact, contact};
  return found;
}

TEST(Reports, ListContacts) {
  GapDiagnosis diagnosis = Diagnosis();
  diagnosis.effects.resize(1);
  diagnosis.effects.push_back(Touched());
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("Something touched the arm 2 times; the model lacks "
                        "stribeck on elbow, which removes 93 %"));
  EXPECT_THAT(FullReport(diagnosis, true),
              HasSubstr("         1.0 to 2.5 s: -40 +- 2 N m on elbow\n"));
  diagnosis.effects = {Touched()};
  EXPECT_EQ(BriefReport(diagnosis), "Something touched the arm 2 times.");
  const json effect = ToJson(diagnosis)["effects"][0];
  EXPECT_EQ(effect["time_windows"][1][1], 2.5);
  EXPECT_EQ(effect["contacts"][1]["torque"][1], -40);
  EXPECT_EQ(effect["contacts"][1]["joint"], "elbow");
  EXPECT_TRUE(effect["contacts"][1]["force"].is_null());
}

TEST(BriefReport, SaysWhatItCannotName) {
  GapDiagnosis diagnosis = Diagnosis();
  diagnosis.effects.clear();
  diagnosis.verdict = GapVerdict::kUnknown;
  EXPECT_THAT(BriefReport(diagnosis),
              HasSubstr("no known effect explains: most of it on elbow, "
                        "ordered by its time."));
  diagnosis.unexplained = {};
  EXPECT_THAT(BriefReport(diagnosis), HasSubstr("no known effect explains."));
  const std::vector<std::pair<GapVerdict, std::string>> others = {
      {GapVerdict::kNoiseFloor, "agrees with the log to within the noise"},
      {GapVerdict::kAbsorbed, "better values"},
      {GapVerdict::kNotTestable, "cannot carry a diagnosis"}};
  diagnosis.torque.refit = 1;
  for (const auto& [verdict, text] : others) {
    diagnosis.verdict = verdict;
    EXPECT_THAT(BriefReport(diagnosis), HasSubstr(text));
  }
}

// Whatever the verdict.
TEST(BriefReport, SaysFirstWhatFrictionHasChanged) {
  GapDiagnosis diagnosis = Diagnosis();
  diagnosis.has_reference = true;
  diagnosis.moved = {{"elbow.viscous", "N m s/rad", 10, 8, .1, -2},
                     {"wrist.coulomb", "N m", 0, .25, .01, 1}};
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

TEST(BriefReport, DoesNotCallItNoiseWhereMoreIsLeft) {
  GapDiagnosis diagnosis = Diagnosis();
  diagnosis.effects.clear();
  for (const GapVerdict verdict :
       {GapVerdict::kNoiseFloor, GapVerdict::kAbsorbed}) {
    diagnosis.verdict = verdict;
    diagnosis.torque.refit = 49;
    EXPECT_THAT(BriefReport(diagnosis), HasSubstr("off by 49 times"));
    diagnosis.torque.refit = 1.9;
    EXPECT_THAT(BriefReport(diagnosis), Not(HasSubstr("off by")));
  }
}

TEST(FullReport, WhatNothingTellsOfIsNotSeen) {
  GapDiagnosis diagnosis = Diagnosis();
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
  const std::string text = FullReport(Diagnosis(), true);
  for (const char* part :
       {"stribeck on elbow: size 1.25 +- 0.04 N m, share 0.5 +- 0.01\n",
        "or 8 % presliding on elbow", "told apart by: constant velocities",
        "forearm.mass", "backlash: the load never reverses (elbow)",
        "currents: no torque column (`torque_constants`)", "removed 93 %",
        "noise told from: assumed"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(FullReport, SaysWhereNothingWasHeldOut) {
  GapDiagnosis diagnosis = Diagnosis();
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
  GapDiagnosis diagnosis = Diagnosis();
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
  GapDiagnosis diagnosis = Diagnosis();
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
  const json all = ToJson(Diagnosis());
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
  const json all = ToJson(Diagnosis());
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
  GapDiagnosis diagnosis = Diagnosis();
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
  GapDiagnosis diagnosis = Diagnosis();
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
