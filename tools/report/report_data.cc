#include "tools/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "model/robot/kinematics.h"

namespace armcal {
namespace {

using Eigen::VectorXd;
using nlohmann::json;

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
          {"position_unit", PositionUnit(joint.type)},
          {"low", low},
          {"high", high}};
}

// {begin, width, mean: per model, per bin, rms}; null where a bin is empty.
json ProfileJson(const BinnedProfile& profile, int models) {
  json mean = json::array(), rms = json::array();
  for (int m = 0; m < models; ++m) {
    json means = json::array(), sizes = json::array();
    for (int k = 0; k < profile.size(); ++k) {
      const bool any = profile.samples(k) > 0;
      means.push_back(any ? Short(profile.Mean(k)[m]) : json());
      sizes.push_back(any ? Short(profile.Rms(k)[m]) : json());
    }
    mean.push_back(means);
    rms.push_back(sizes);
  }
  return {{"begin", profile.begin()},
          {"width", profile.width()},
          {"mean", mean},
          {"rms", rms}};
}

json MapJson(const ResidualMap& map, int models) {
  return {{"position", ProfileJson(map.position, models)},
          {"velocity", ProfileJson(map.velocity, models)},
          {"load", ProfileJson(map.load, models)},
          {"time", ProfileJson(map.time, models)}};
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

json PositionsJson(const Robot& robot, const std::vector<std::string>& labels,
                   const std::vector<PositionTrace>& traces) {
  const int n = robot.num_joints(), models = static_cast<int>(labels.size());
  json list = json::array();
  for (const PositionTrace& trace : traces) {
    json joints = json::array();
    for (int j = 0; j < n; ++j) {
      joints.push_back(
          JointTraceJson(robot.links[j].joint, j, n, models, trace.follows));
    }
    list.push_back({{"log", trace.log},
                    {"logs", traces.size()},
                    {"labels", labels},
                    {"t", TimesJson(trace.follows)},
                    {"joints", joints}});
  }
  return list;
}

json TracesJson(const Robot& robot, const DrawnTorques& drawn) {
  json list = json::array();
  const int n = robot.num_joints();
  const int count = static_cast<int>(drawn.labels.size());
  for (const TorqueTrace& trace : drawn.traces) {
    if (list.size() == kMostDrawnLogs) break;
    json joints = json::array();
    for (int j = 0; j < n; ++j) {
      joints.push_back(
          JointTraceJson(robot.links[j].joint, j, n, count, trace.torque));
      joints.back()["where"] = MapJson(trace.where[j], count);
    }
    list.push_back({{"log", drawn.logs[trace.log]},
                    {"logs", drawn.traces.size()},
                    {"labels", drawn.labels},
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

json CorrelationsJson(const std::string& title,
                      const std::vector<std::string>& names,
                      const Eigen::MatrixXd& covariance,
                      const std::vector<bool>& identifiable) {
  json shown = json::array(), values = json::array();
  std::vector<int> seen;
  for (int k = 0; k < covariance.rows(); ++k) {
    if (!identifiable[k] || !(covariance(k, k) > 0)) continue;
    seen.push_back(k);
    shown.push_back(names[k]);
  }
  for (const int r : seen) {
    json row = json::array();
    for (const int c : seen) {
      const double correlation =
          covariance(r, c) / std::sqrt(covariance(r, r) * covariance(c, c));
      row.push_back(std::round(1e3 * correlation) / 1e3);
    }
    values.push_back(row);
  }
  return {{"title", title}, {"names", shown}, {"values", values}};
}

json SkeletonJson(const Robot& robot, const VectorXd& q) {
  json skeleton = {{"joints", robot.JointNames()},
                   {"points", PosturesJson(robot, q.transpose())[0]}};
  if (robot.branches()) {
    skeleton["before"] = robot.parents;
    skeleton["before"].push_back(robot.num_joints() - 1);
  }
  return skeleton;
}

json PosturesJson(const Robot& robot, const Eigen::MatrixXd& q) {
  json postures = json::array();
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    json points = json::array();
    const auto add = [&points](const Eigen::Isometry3d& pose) {
      const Eigen::Vector3d p = pose.translation();
      points.push_back({Short(p.x()), Short(p.y()), Short(p.z())});
    };
    const std::vector<Eigen::Isometry3d> X_WL = LinkPoses(robot, q.row(k));
    for (int i = 0; i < robot.num_joints(); ++i) {
      const int parent = robot.parent(i);
      add(parent < 0 ? robot.links[i].X_PF
                     : X_WL[parent] * robot.links[i].X_PF);
    }
    add(X_WL.back() * robot.X_LT);
    postures.push_back(points);
  }
  return postures;
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
