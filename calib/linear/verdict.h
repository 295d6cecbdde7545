#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Sentences that say why a calibration that ran does not give what was asked
// for: it has no solution, nothing can be seen from such data, a joint never
// moves, or the model does not explain what was measured. Directions that are
// not excited although all joints move are no reason: they are named, and the
// others hold. None where all is well.
std::vector<std::string> Shortcomings(const Robot& robot,
                                      const LinearCalibration& result);

// Adds a sentence for each joint that stays where it is, which ends with
// `what` that leaves unknown. Travel is its largest position less its smallest,
// rad or m.
void AddUnmoved(const Robot& robot, const Eigen::VectorXd& travel,
                const std::string& what, std::vector<std::string>* sentences);

// {passed, reasons[]}.
nlohmann::json VerdictJson(const std::vector<std::string>& shortcomings);

// One line for each, for a terminal.
std::string VerdictText(const std::vector<std::string>& shortcomings);

}  // namespace armcal
