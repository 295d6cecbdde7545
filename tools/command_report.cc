#include "tools/command_report.h"

#include "tools/input_flags.h"
#include "tools/input_hash.h"
#include "tools/report/report_data.h"

namespace armcal {

CommandOutcome OutcomeOf(const CommandInput& input, const Robot& robot,
                         const Summary& summary,
                         const std::vector<std::string>& notes) {
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  for (const ResultFile& file : summary.files) out.Add(file.name, file.content);
  outcome.output = {summary.json, summary.report, robot.name + ": ",
                    summary.positive, notes};
  outcome.brief = summary.brief;
  return outcome;
}

void AddProvenance(const CommandInput& input,
                   const std::vector<std::string>& files,
                   ReportContent* content) {
  content->arguments = {"armcal", content->command};
  for (const std::string& flag : input.flags.AsTyped()) {
    content->arguments.push_back(flag);
  }
  for (const std::string& file : files) {
    content->files.push_back(HashInput(input, file));
  }
}

void AddReport(const CommandInput& input, const std::string& command,
               const Robot& robot, const std::string& json,
               const std::vector<std::string>& files,
               const std::function<void(ReportContent*)>& complete,
               OutputFolder* out) {
  if (!input.WantsReport()) return;
  ReportContent content;
  content.command = command;
  content.robot = robot.name;
  content.result = nlohmann::json::parse(json);
  content.skeleton = SkeletonJson(robot, BentPosture(robot));
  content.files.push_back(HashDocument(RobotFileFromFlags(input)));
  AddProvenance(input, files, &content);
  if (complete) complete(&content);
  out->Add("report.html", ReportPage(content));
}

}  // namespace armcal
