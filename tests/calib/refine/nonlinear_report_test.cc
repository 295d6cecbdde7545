#include "calib/refine/nonlinear_report.h"

#include <gmock/gmock.h>

#include <sstream>

#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::nonlinear_report_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

struct Case {
  Robot file;
  NonlinearRun run;
  json linear;  // what AddRefined is given
};

// A calibration whose names are as long as they come, or short.
Case MakeCase(const std::string& link_name, const std::string& joint_name) {
  std::mt19937_64 random(21);
  SimulatedArm arm = MakeArm("3R elbow", .3, &random);
  for (Robot* robot : {&arm.file, &arm.truth}) {
    robot->links[0].name = "a";
    robot->links[1].name = link_name;
    robot->links[2].joint.name = joint_name;
  }
  Case made{arm.file, Calibrate(arm, .01, {}, &random), {}};
  // A linear calibration's joints and parameters stand for all of ToJson.
  json& c = made.linear;
  c["estimate"] = "linear";
  for (const Link& link : arm.file.links) {
    c["joints"].push_back({{"name", link.joint.name}, {"residual_rms", 99}});
  }
  c["parameters"] = json::array({{{"name", "old"}}});
  c["stacked_residual_percent"] = 77;
  c["validation_stacked_residual_percent"] = 78;
  return made;
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The rows of the table whose head starts with `head`.
std::vector<std::string> Table(const std::string& text,
                               const std::string& head) {
  std::vector<std::string> rows;
  for (const std::string& line : Lines(text)) {
    if (line.rfind(head, 0) == 0 || !rows.empty()) rows.push_back(line);
    if (!rows.empty() && line.empty()) break;
  }
  if (!rows.empty()) rows.pop_back();
  return rows;
}

TEST(NonlinearReport, ColumnsLineUpWhateverTheNames) {
  const std::string name(40, 'x');
  for (const auto& [link, joint] :
       {std::make_pair(std::string("b"), std::string("c")),
        std::make_pair(name, std::string("c")), std::make_pair(name, name)}) {
    const Case c = MakeCase(link, joint);
    const std::string text = NonlinearReport(c.file, c.run.physical);
    SCOPED_TRACE(text);
    const auto links = Table(text, "robot for a simulator");
    ASSERT_EQ(links.size(), 4u);
    for (size_t i = 1; i < links.size(); ++i) {
      EXPECT_EQ(links[i].find(')'), links[0].find("(file)") + 5);
      EXPECT_EQ(links[i].size(), links[1].size());
    }
    const auto joints = Table(text, "  joint");
    ASSERT_EQ(joints.size(), 4u);
    for (size_t i = 1; i < joints.size(); ++i) {
      // After the value of every column stands "+-" or "(not alone)".
      size_t at = joints[0].find("viscous") + 8;
      EXPECT_EQ(joints[i].substr(at, 2), "+-");
      at = joints[0].find("coulomb") + 8;
      EXPECT_EQ(joints[i].substr(at, 2), "+-");
      at = joints[0].find("armature") + 8;
      EXPECT_THAT(joints[i].substr(at, 2), testing::AnyOf("+-", "(n"));
    }
    EXPECT_THAT(text, HasSubstr("\nresidual of this robot 1.0"));
    EXPECT_THAT(text, HasSubstr(", held out 1.0"));
    EXPECT_THAT(text, Not(HasSubstr("nan")));
    EXPECT_THAT(text, Not(HasSubstr(" \n")));
  }
}

TEST(NonlinearReport, SaysWhatDidNotWork) {
  Case c = MakeCase("b", "c");
  c.run.physical.reason = "NO_CONVERGENCE";
  EXPECT_THAT(NonlinearReport(c.file, c.run.physical),
              HasSubstr("\nnot converged: NO_CONVERGENCE after "));
  AddRefined(c.run.physical, &c.linear);
  EXPECT_EQ(c.linear["refined"]["converged"], false);
  c.run.physical.training = TorqueResidual(3);  // of nothing
  const std::string text = NonlinearReport(c.file, c.run.physical);
  EXPECT_THAT(text, Not(HasSubstr("nan")));

  NonlinearCalibration refused;
  refused.reason = "for a reason";
  EXPECT_EQ(NonlinearReport(c.file, refused),
            "\nno physically consistent robot: for a reason\n");
  json calibration = {{"estimate", "linear"}, {"parameters", {1}}};
  AddRefined(refused, &calibration);
  EXPECT_EQ(calibration["estimate"], "linear");
  EXPECT_EQ(calibration["parameters"], json({1}));
  EXPECT_EQ(calibration["refined"]["converged"], false);
  EXPECT_EQ(calibration["refined"]["reason"], "for a reason");
}

TEST(AddRefined, DescribesTheRefinedEstimateAndKeepsTheLinear) {
  Case made = MakeCase("b", "c");
  const NonlinearCalibration& physical = made.run.physical;
  const json before = made.linear;
  json c = made.linear;
  AddRefined(physical, &c);
  EXPECT_EQ(c["estimate"], "refined");
  EXPECT_EQ(c["linear"]["joints"], before["joints"]);
  EXPECT_EQ(c["linear"]["parameters"], before["parameters"]);
  EXPECT_EQ(c["linear"]["stacked_residual_percent"], 77);
  EXPECT_EQ(c["linear"]["validation_stacked_residual_percent"], 78);
  EXPECT_EQ(c["stacked_residual_percent"],
            physical.training->moving().stacked_percent);
  for (int j = 0; j < 3; ++j) {
    const json& joint = c["joints"][j];
    const auto moving = physical.training->moving();
    EXPECT_EQ(joint["name"], before["joints"][j]["name"]);
    EXPECT_EQ(joint["residual_rms"], moving.residual_rms[j]);
    EXPECT_EQ(joint["residual_percent"], moving.percent[j]);
    EXPECT_EQ(joint["validation_residual_rms"],
              physical.validation->moving().residual_rms[j]);
    EXPECT_EQ(joint["validation_residual_percent"],
              physical.validation->moving().percent[j]);
  }
  ASSERT_EQ(c["parameters"].size(), physical.parameters.size());
  for (size_t k = 0; k < physical.parameters.size(); ++k) {
    const PhysicalParameter& p = physical.parameters[k];
    const json& entry = c["parameters"][k];
    EXPECT_EQ(entry["name"], p.name);
    EXPECT_EQ(entry["unit"], p.unit);
    EXPECT_EQ(entry["value"], p.value);
    EXPECT_EQ(entry["prior"], p.prior);
    EXPECT_EQ(entry["identifiable"], p.identifiable);
    EXPECT_EQ(entry["stddev"].is_null(), !p.identifiable);
    EXPECT_EQ(c["parameters_covariance"]["names"][k], p.name);
  }
  EXPECT_EQ(c["refined"]["converged"], true);
  EXPECT_GT(c["refined"]["iterations"], 0);
}

TEST(ParametersCovarianceCsv, LeavesOutWhatTheLogsDoNotTell) {
  const NonlinearCalibration physical = MakeCase("b", "c").run.physical;
  const auto lines = Lines(ParametersCovarianceCsv(physical));
  const auto& p = physical.parameters;
  ASSERT_EQ(lines.size(), p.size() + 1);
  EXPECT_EQ(lines[0].rfind("\"a.mass\",\"a.hx\",", 0), 0u);
  for (size_t r = 0; r < p.size(); ++r) {
    std::istringstream row(lines[r + 1] + ",");
    for (size_t k = 0; k < p.size(); ++k) {
      std::string field;
      ASSERT_TRUE(std::getline(row, field, ','));
      const bool known = p[r].identifiable && p[k].identifiable;
      ASSERT_EQ(!field.empty(), known) << p[r].name << " " << p[k].name;
      EXPECT_TRUE(!known || std::stod(field) == physical.covariance(r, k));
    }
  }
}

TEST(ParametersPosteriorCsv, HasAllParameters) {
  const NonlinearCalibration physical = MakeCase("b", "c").run.physical;
  const auto lines = Lines(ParametersPosteriorCsv(physical));
  const auto& p = physical.parameters;
  ASSERT_EQ(lines.size(), p.size() + 1);
  for (size_t r = 0; r < p.size(); ++r) {
    std::istringstream row(lines[r + 1]);
    for (size_t k = 0; k < p.size(); ++k) {
      std::string field;
      ASSERT_TRUE(std::getline(row, field, ','));
      EXPECT_EQ(std::stod(field), physical.covariance(r, k));
    }
  }
}

}  // namespace armcal::nonlinear_report_test
