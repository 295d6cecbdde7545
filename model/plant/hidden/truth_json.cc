#include "model/plant/hidden/truth_json.h"

#include <cmath>

namespace armcal {

namespace {

using nlohmann::json;

json Numbers(const Eigen::VectorXd& values) {
  json list = json::array();
  // JSON has no infinity.
  for (const double x : values) {
    list.push_back(std::isfinite(x) ? json(x) : json(nullptr));
  }
  return list;
}

// Name, joint and the values applied, in SI units.
json EffectJson(const AppliedEffect& effect, const Robot& robot) {
  json values = json::array();
  for (const EffectValue& value : effect.values) {
    values.push_back(
        {{"name", value.name}, {"unit", value.unit}, {"value", value.value}});
  }
  json entry = {{"effect", effect.name},
                {"joint_index", effect.joint + 1},
                {"in_catalogue", effect.in_catalogue},
                {"values", values}};
  if (effect.joint >= 0) {
    entry["joint"] = robot.links[effect.joint].joint.name;
  }
  return entry;
}

// The names and units of calibration.json.
json ParametersJson(const Robot& robot) {
  json list = json::array();
  const auto add = [&list](const std::string& name, const std::string& unit,
                           double value) {
    list.push_back({{"name", name}, {"unit", unit}, {"value", value}});
  };
  for (const Link& link : robot.links) {
    const Vector10d inertial = link.inertial.ToVector();
    for (int k = 0; k < 10; ++k) {
      add(link.name + "." + InertialName(k), InertialUnit(k), inertial[k]);
    }
  }
  for (const Link& link : robot.links) {
    const Joint& joint = link.joint;
    const bool turns = IsRotational(joint.type);
    add(joint.name + ".viscous", turns ? "N m s/rad" : "N s/m", joint.viscous);
    add(joint.name + ".coulomb", EffortUnit(joint.type), joint.coulomb);
    add(joint.name + ".offset", EffortUnit(joint.type), joint.offset);
    add(joint.name + ".armature", turns ? "kg m^2" : "kg", joint.armature);
  }
  return list;
}

// As ReadController takes it; limits that are infinite are left out.
json ControllerJson(const ControllerOptions& options) {
  const char* const names[] = {"none", "gravity", "inverse_dynamics"};
  json controller = {
      {"law", DriveKindName(options.kind)},
      {"rate", options.rate_hz},
      {"delay", options.delay},
      {"velocity_filter", options.velocity_filter_hz},
      {"feedforward", names[static_cast<int>(options.feedforward)]}};
  for (const DriveParameter& parameter : DriveParameters()) {
    Eigen::VectorXd values(options.drives.size());
    for (int j = 0; j < values.size(); ++j) {
      values[j] = options.drives[j].*parameter.value;
    }
    if (HasParameter(options.kind, parameter) && values.allFinite()) {
      controller[parameter.name] = Numbers(values);
    }
  }
  return controller;
}

json SensorsJson(const SensorOptions& options) {
  return {{"encoder_resolution", Numbers(options.encoder_resolution)},
          {"encoder_noise", Numbers(options.encoder_noise)},
          {"torque_noise", Numbers(options.torque_noise)},
          {"coloured_noise", Numbers(options.coloured_noise)},
          {"noise_correlation", options.noise_correlation},
          {"torque_delay", options.torque_delay},
          {"log_rate", options.log_rate_hz},
          {"jitter", options.jitter},
          {"lost_share", options.lost_share}};
}

}  // namespace

json TruthJson(const Scenario& scenario, const ScenarioRun& run) {
  json effects = json::array();
  for (const AppliedEffect& effect : run.effects) {
    effects.push_back(EffectJson(effect, run.robot));
  }
  return {{"seed", scenario.seed},
          {"run", scenario.run},
          {"robot", run.robot.name},
          {"robot_error", scenario.robot_error},
          {"zero_velocity", scenario.zero_velocity},
          {"effects", effects},
          {"parameters", ParametersJson(run.robot)},
          {"controller", ControllerJson(scenario.loop.controller)},
          {"sensors", SensorsJson(scenario.loop.sensors)},
          {"step", scenario.loop.step},
          {"samples", run.run.log.size()},
          {"saturated_share", run.run.saturated_share},
          {"tracking_rms", Numbers(run.run.tracking_rms)}};
}

}  // namespace armcal
