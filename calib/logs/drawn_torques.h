#pragma once

#include <string>
#include <vector>

#include "calib/logs/torque_trace.h"
#include "model/robot/robot.h"

namespace armcal {

// Torques of logs beside those of models, for drawing.
struct DrawnTorques {
  std::vector<std::string> labels;  // of the models
  std::vector<std::string> logs;    // names, which traces have numbers of
  std::vector<TorqueTrace> traces;
};

// The robot's own parameters, its Coulomb friction changing sign by
// `transitions` (one per joint; empty: within 5 mrad/s or mm/s).
TracedModel TraceRobot(const std::string& label, const Robot& robot,
                       const std::vector<CoulombTransition>& transitions);

// Of every log, in one pass, in as many bins as a page can draw.
DrawnTorques DrawTorques(const std::vector<TracedModel>& models,
                         const Progress& progress, const PreparedLogs& logs);

}  // namespace armcal
