#include "tools/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "model/kinematics.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using nlohmann::json;

// So that a page stays below 10 MB whatever the logs.
int MostBins(int logs) { return std::clamp(12'000 / logs, 200, 2000); }

json Short(double value) {
  if (!std::isfinite(value)) return nullptr;
  char text[40];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

json SignalJson(const SeriesEnvelope& envelope, int signal, bool high) {
  json list = json::array();
  for (const SeriesEnvelope::Bin& bin : envelope.bins()) {
    if (!bin.follows && !list.empty()) list.push_back(nullptr);
    list.push_back(Short((high ? bin.high : bin.low)[signal]));
  }
  return list;
}

// With a point in the middle of every gap.
json TimesJson(const SeriesEnvelope& envelope) {
  json list = json::array();
  double last = 0;
  for (const SeriesEnvelope::Bin& bin : envelope.bins()) {
    const double middle = (bin.begin + bin.end) / 2;
    if (!bin.follows && !list.empty()) list.push_back((last + middle) / 2);
    list.push_back(std::round(middle * 1e4) / 1e4);
    last = middle;
  }
  return list;
}

json JointTraceJson(const Joint& joint, int j, int n, int models,
                    const SeriesEnvelope& envelope) {
  json low = json::array(), high = json::array();
  for (int k = 0; k <= 2 * models; ++k) {
    low.push_back(SignalJson(envelope, k * n + j, false));
    high.push_back(SignalJson(envelope, k * n + j, true));
  }
  return {{"name", joint.name},
          {"unit", EffortUnit(joint.type)},
          {"low", low},
          {"high", high}};
}

// {f, density: per model, per joint}.
json SpectrumJson(const PowerSpectrum& spectrum, int models, int n) {
  json density = json::array();
  const Eigen::MatrixXd all = spectrum.Density();
  for (int m = 0; m < models; ++m) {
    json of_model = json::array();
    for (int j = 0; j < n; ++j) {
      of_model.push_back(RoundedJson(all.col(m * n + j)));
    }
    density.push_back(of_model);
  }
  return {{"f", RoundedJson(spectrum.Frequencies())}, {"density", density}};
}

}  // namespace

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

json TracesJson(const Robot& robot, const std::vector<TracedModel>& models,
                LogSet* logs, const Progress& progress) {
  json list = json::array();
  const int n = robot.num_joints(), count = static_cast<int>(models.size());
  json labels = json::array();
  for (const TracedModel& model : models) labels.push_back(model.label);
  for (const TorqueTrace& trace :
       TraceTorques(models, MostBins(logs->size()), progress, logs)) {
    json joints = json::array();
    for (int j = 0; j < n; ++j) {
      joints.push_back(
          JointTraceJson(robot.links[j].joint, j, n, count, trace.torque));
    }
    list.push_back({{"log", logs->path(trace.log)},
                    {"labels", labels},
                    {"t", TimesJson(trace.torque)},
                    {"joints", joints}});
    if (!trace.residual.empty()) {
      list.back()["spectrum"] = SpectrumJson(trace.residual, count, n);
    }
  }
  return list;
}

json RoundedJson(const VectorXd& values) {
  json list = json::array();
  for (const double x : values) list.push_back(Short(x));
  return list;
}

json SignalsJson(const Eigen::MatrixXd& columns) {
  json list = json::array();
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    list.push_back(RoundedJson(columns.col(j)));
  }
  return list;
}

json CorrelationsJson(const LinearCalibration& result) {
  json names = json::array(), values = json::array();
  std::vector<int> seen;
  for (int k = 0; k < result.x.size(); ++k) {
    if (!result.identifiable[k] || !(result.stddev[k] > 0)) continue;
    seen.push_back(k);
    names.push_back(result.parameters.parameters()[k].name);
  }
  for (const int r : seen) {
    json row = json::array();
    for (const int c : seen) {
      const double correlation =
          result.covariance(r, c) / (result.stddev[r] * result.stddev[c]);
      row.push_back(std::round(1e3 * correlation) / 1e3);
    }
    values.push_back(row);
  }
  return {{"names", names}, {"values", values}};
}

json SkeletonJson(const Robot& robot, const VectorXd& q) {
  json points = json::array();
  const auto add = [&points](const Eigen::Vector3d& p) {
    points.push_back({Short(p.x()), Short(p.y()), Short(p.z())});
  };
  for (const Eigen::Isometry3d& pose : LinkPoses(robot, q)) {
    add(pose.translation());
  }
  add(ToolPose(robot, q).translation());
  return {{"joints", robot.JointNames()}, {"points", points}};
}

VectorXd BentPosture(const Robot& robot) {
  VectorXd q(robot.num_joints());
  for (int j = 0; j < q.size(); ++j) {
    const bool revolute = robot.links[j].joint.type == JointType::kRevolute;
    q[j] = revolute ? (j % 2 == 0 ? .5 : -.7) : .1;
  }
  return q;
}

}  // namespace armcal
