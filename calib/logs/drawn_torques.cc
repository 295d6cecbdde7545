#include "calib/logs/drawn_torques.h"

namespace armcal {

TracedModel TraceRobot(const std::string& label, const Robot& robot,
                       const std::vector<CoulombTransition>& transitions) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  for (int j = 0; j < robot.num_joints(); ++j) {
    options.transitions.push_back(
        {transitions.empty()
             ? CoulombTransition{CoulombTransition::Law::kVelocity, .005}
             : transitions[j]});
  }
  const ModelParameters parameters(robot, options);
  return {label, parameters, parameters.Values(robot)};
}

DrawnTorques DrawTorques(const std::vector<TracedModel>& models,
                         const Progress& progress, const PreparedLogs& logs) {
  const int bins =
      MostTraceBins(logs.size(), models.at(0).parameters.num_joints(),
                    static_cast<int>(models.size()));
  DrawnTorques drawn;
  for (const TracedModel& model : models) drawn.labels.push_back(model.label);
  for (int log = 0; log < logs.size(); ++log) {
    drawn.logs.push_back(logs.logs().path(log));
  }
  drawn.traces = TraceTorques(models, bins, progress, logs);
  return drawn;
}

}  // namespace armcal
