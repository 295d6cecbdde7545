#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "calib/linear_calibration.h"
#include "calib/log_set.h"
#include "calib/torque_trace.h"
#include "model/robot.h"

namespace armcal {

// The robot's own parameters, its Coulomb friction changing sign by
// `transitions` (one per joint; empty: within 5 mrad/s or mm/s).
TracedModel TraceRobot(const std::string& label, const Robot& robot,
                       const std::vector<CoulombTransition>& transitions);

// [{log, labels: [model], joints: [{name, unit, t, low, high}], spectrum}],
// with `low` and `high` a list per signal of TorqueTrace. Numbers
// have 5 digits; null ends a stretch.
nlohmann::json TracesJson(const Robot& robot,
                          const std::vector<TracedModel>& models, LogSet* logs,
                          const Progress& progress);

// Numbers of 5 digits; a list per column.
nlohmann::json RoundedJson(const Eigen::VectorXd& values);
nlohmann::json SignalsJson(const Eigen::MatrixXd& columns);

// {names, values: a list per row}: correlations of the parameters that the logs
// show, to three decimals.
nlohmann::json CorrelationsJson(const LinearCalibration& result);

// {joints: [name], points: [[x, y, z]]}: origins of the links and the tool at a
// posture, base to tip, m.
nlohmann::json SkeletonJson(const Robot& robot, const Eigen::VectorXd& q);
// The posture in the middle of a robot's limits that is not stretched out.
Eigen::VectorXd BentPosture(const Robot& robot);

}  // namespace armcal
