#include "tools/command_report.h"

#include "calib/numerics/sha256.h"
#include "tools/input_flags.h"
#include "tools/input_hash.h"
#include "tools/report/report_data.h"
#include "tools/source_hash.h"

namespace armcal {
namespace {

ReportContent ContentOf(const CommandInput& input, const std::string& command,
                        const std::vector<std::string>& files) {
  ReportContent content;
  content.command = command;
  content.arguments = {"armcal", command};
  for (const std::string& flag : input.flags.AsTyped()) {
    content.arguments.push_back(flag);
  }
  if (input.robot || !input.flags.Text("robot").empty()) {
    content.files.push_back(HashDocument(RobotFileFromFlags(input)));
  }
  for (const std::string& file : files) {
    content.files.push_back(HashInput(input, file));
  }
  const std::string controller = input.flags.Text("controller");
  if (!controller.empty()) content.files.push_back(HashFile(controller));
  content.source_hash = SourceHash();
  return content;
}

void AddProvenanceOf(const ReportContent& content, OutputFolder* out) {
  nlohmann::json provenance = ProvenanceJson(content);
  for (const auto& [name, text] : out->files()) {
    provenance["results"].push_back({{"path", name},
                                     {"sha256", HexText(Sha256Of(text))},
                                     {"bytes", text.size()}});
  }
  // Names of files may be no UTF-8.
  out->Add(
      "provenance.json",
      provenance.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
          "\n");
}

}  // namespace

CommandOutcome OutcomeOf(const CommandInput& input, const Robot& robot,
                         const Summary& summary,
                         const std::vector<std::string>& notes) {
  CommandOutcome outcome = OutcomeWithoutRobot(input, summary);
  outcome.output.verdict = robot.name + ": ";
  outcome.output.notes = notes;
  return outcome;
}

CommandOutcome OutcomeWithoutRobot(const CommandInput& input,
                                   const Summary& summary) {
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  for (const ResultFile& file : summary.files) out.Add(file.name, file.content);
  outcome.output = {summary.json, summary.report, "", summary.positive, {}};
  outcome.brief = summary.brief;
  return outcome;
}

void AddProvenance(const CommandInput& input, const std::string& command,
                   const std::vector<std::string>& files, OutputFolder* out) {
  if (!input.WantsReport()) return;
  AddProvenanceOf(ContentOf(input, command, files), out);
}

void AddReport(const CommandInput& input, const std::string& command,
               const Robot& robot, const std::string& json,
               const std::vector<std::string>& files,
               const std::function<void(ReportContent*)>& complete,
               OutputFolder* out) {
  AddReportWithoutRobot(
      input, command, robot.name, json, files,
      [&](ReportContent* content) {
        content->skeleton = SkeletonJson(robot, BentPosture(robot));
        if (complete) complete(content);
      },
      out);
}

void AddReportWithoutRobot(const CommandInput& input,
                           const std::string& command,
                           const std::string& robot_name,
                           const std::string& json,
                           const std::vector<std::string>& files,
                           const std::function<void(ReportContent*)>& complete,
                           OutputFolder* out) {
  if (!input.WantsReport()) return;
  ReportContent content = ContentOf(input, command, files);
  content.robot = robot_name;
  content.result = nlohmann::json::parse(json);
  if (complete) complete(&content);
  AddProvenanceOf(content, out);
  out->Add("report.html", ReportPage(content));
}

}  // namespace armcal
