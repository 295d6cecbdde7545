#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "calib/closed_loop/position_trace.h"
#include "calib/logs/drawn_torques.h"
#include "model/robot/robot.h"

namespace armcal {

// [{log, logs: how many there are, labels: [model], t, joints: [{name, unit,
// position_unit, low, high, where}], spectrum}], with `low` and `high` a list
// per signal of TorqueTrace and `where` ProfileJson of each coordinate. Numbers
// have 5 digits; null ends a stretch.
nlohmann::json TracesJson(const Robot& robot, const DrawnTorques& drawn);

// The same of positions: {log, logs, labels, t, joints}.
nlohmann::json PositionsJson(const Robot& robot,
                             const std::vector<std::string>& labels,
                             const std::vector<PositionTrace>& traces);

// Numbers of 5 digits; a list per column.
nlohmann::json RoundedJson(const Eigen::VectorXd& values);
nlohmann::json SignalsJson(const Eigen::MatrixXd& columns);

// {title, names, values: a list per row}: correlations of the parameters that
// the logs show, to three decimals.
nlohmann::json CorrelationsJson(const std::string& title,
                                const std::vector<std::string>& names,
                                const Eigen::MatrixXd& covariance,
                                const std::vector<bool>& identifiable);

// {joints: [name], points: [[x, y, z]]}: where the joints are and the tool at a
// posture, base to tip, m.
nlohmann::json SkeletonJson(const Robot& robot, const Eigen::VectorXd& q);
// [points of SkeletonJson], a posture per row.
nlohmann::json PosturesJson(const Robot& robot, const Eigen::MatrixXd& q);
// The posture in the middle of a robot's limits that is not stretched out.
Eigen::VectorXd BentPosture(const Robot& robot);

}  // namespace armcal
