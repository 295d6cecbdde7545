#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calib/summary.h"
#include "model/robot/robot.h"
#include "tools/command.h"
#include "tools/output_folder.h"
#include "tools/report/report_page.h"

namespace armcal {

// What a summary says, its files those of --out. `notes`: what the reader of
// the robot file has to say, where the command tells it.
CommandOutcome OutcomeOf(const CommandInput& input, const Robot& robot,
                         const Summary& summary,
                         const std::vector<std::string>& notes);

// The same of a command that is of no one robot.
CommandOutcome OutcomeWithoutRobot(const CommandInput& input,
                                   const Summary& summary);

// Adds provenance.json to the results, where the input wants files: the command
// line, versions, the hashes of the robot file, of `files` and of the results.
void AddProvenance(const CommandInput& input, const std::string& command,
                   const std::vector<std::string>& files, OutputFolder* out);

// Adds provenance.json, and report.html, which holds that as well: the
// summary's JSON, the command line, the robot at a bent posture, the hashes of
// the robot file and of `files`, and what `complete` (or null) knows besides.
void AddReport(const CommandInput& input, const std::string& command,
               const Robot& robot, const std::string& json,
               const std::vector<std::string>& files,
               const std::function<void(ReportContent*)>& complete,
               OutputFolder* out);
// The same of a command whose robot is not drawn.
void AddReportWithoutRobot(const CommandInput& input,
                           const std::string& command,
                           const std::string& robot_name,
                           const std::string& json,
                           const std::vector<std::string>& files,
                           const std::function<void(ReportContent*)>& complete,
                           OutputFolder* out);

}  // namespace armcal
