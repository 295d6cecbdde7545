#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// One sentence: how good, on what, and whether anything stayed unseen.
std::string BriefReport(const Robot& robot, const LinearCalibration& result);

// Everything a person needs on a terminal: data, residuals per joint, ranks,
// lengths, friction, parameters with standard deviations.
std::string FullReport(const Robot& robot, const LogSet& training,
                       const LinearCalibration& result);

// The part of it that the logs themselves are not needed for: ranks, lengths,
// Coulomb friction's transitions, parameters, shortcomings.
std::string EstimateText(const Robot& robot, const LinearCalibration& result);

// calibration.json (docs/files.md). Infinite and undefined numbers are null.
nlohmann::json ToJson(const Robot& robot, const LogSet& training,
                      const LogSet* validation,
                      const LinearCalibration& result);

// The keys of it that tell nothing of the logs.
nlohmann::json ToJson(const Robot& robot, const LinearCalibration& result);

// covariance.csv: a header of the model parameters' names, then the matrix, its
// entries empty where a parameter is not identifiable; the header alone where
// nothing was solved, so that no older matrix stands beside a refusal.
std::string CovarianceCsv(const LinearCalibration& result);

// "move joint4 and joint5 together (34 of 36 then), joint1 (36 of 36)".
std::string AdviceText(const Robot& robot,
                       const std::vector<AdvisedMotion>& motions, int total);

}  // namespace armcal
