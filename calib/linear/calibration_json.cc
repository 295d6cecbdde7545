#include <cmath>
#include <cstdio>

#include "calib/linear/calibration_report.h"
#include "calib/linear/calibration_warnings.h"
#include "calib/linear/error_density.h"
#include "calib/linear/joint_figures.h"
#include "calib/linear/outlier_report.h"
#include "calib/linear/verdict.h"
#include "calib/numerics/json_figures.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr int kListedOutliers = 100;  // all are in outliers.csv

const char* SolverName(LinearSolver solver) {
  switch (solver) {
    case LinearSolver::kWeighted:
      return "weighted";
    case LinearSolver::kBatch:
      return "batch";
    case LinearSolver::kRecursive:
      return "recursive";
  }
  return "";
}

json LogsJson(const LogSet& logs) {
  json result = json::array();
  for (int k = 0; k < logs.size(); ++k) {
    const TimeBase& base = logs.time_bases()[k];
    result.push_back({{"file", logs.path(k)},
                      {"samples", base.samples},
                      {"seconds", base.range.end - base.range.begin},
                      {"begin_s", base.range.begin},
                      {"end_s", base.range.end},
                      {"resampled", !base.uniform},
                      {"gaps", base.gaps.size()}});
  }
  return result;
}

json FrictionJson(const std::optional<FrictionBand>& friction) {
  if (!friction) return nullptr;
  return {{"position", friction->position_hz},
          {"velocity", friction->velocity_hz}};
}

json TransitionJson(const CoulombTransition& t, JointType type) {
  const bool velocity = t.law == CoulombTransition::Law::kVelocity;
  return {{"law", velocity ? "velocity" : "displacement"},
          {"width", t.width},
          {"unit", std::string(PositionUnit(type)) + (velocity ? "/s" : "")}};
}

// `noise_stddev` is of a row, which in the weak form is an average over a
// window; `noise_density` is what rows of any length can be compared by.
json JointsJson(const Robot& robot, const LinearCalibration& result) {
  json joints = json::array();
  const Eigen::VectorXd density = ErrorDensity(result);
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Joint& joint = robot.links[i].joint;
    json entry = {{"name", joint.name},
                  {"unit", EffortUnit(joint.type)},
                  {"noise_stddev", JsonNumber(result.noise[i])},
                  {"noise_density", JsonNumber(density[i])}};
    if (result.training) SetJointFigures(*result.training, "", i, &entry);
    if (result.validation) {
      SetJointFigures(*result.validation, "validation_", i, &entry);
    }
    if (!result.sample_noise.empty()) {
      const SampleNoise& noise = result.sample_noise[i];
      entry["sample_noise_stddev"] = JsonNumber(noise.stddev);
      entry["noise_source"] = NoiseSourceName(noise.source);
    }
    if (result.encoder_noise.size() > 0) {
      entry["encoder_noise_stddev"] = JsonNumber(result.encoder_noise[i]);
    }
    if (!result.outliers.empty()) entry["outliers"] = result.outliers[i];
    if (!result.transitions.empty()) {
      entry["coulomb_transition"] =
          TransitionJson(result.transitions[i], joint.type);
    } else if (joint.coulomb != 0) {  // the file's, which was not estimated
      entry["coulomb_transition"] = TransitionJson({}, joint.type);
    }
    joints.push_back(entry);
  }
  return joints;
}

json ModelParametersJson(const LinearCalibration& result) {
  json list = json::array();
  for (int k = 0; k < result.parameters.size(); ++k) {
    const ModelParameter& p = result.parameters.parameters()[k];
    list.push_back(
        {{"name", p.name},
         {"unit", p.unit},
         {"value", result.solved ? JsonNumber(result.x[k]) : nullptr},
         {"stddev",
          result.solved ? JsonNumber(result.stddev[k]) : json(nullptr)},
         {"block", p.block + 1},
         {"identifiable", result.solved && result.identifiable[k]}});
  }
  return list;
}

// What a linear calibration knows of physical parameters: the joint terms.
json ParametersJson(const Robot& robot, const LinearCalibration& result) {
  json list = json::array();
  for (int k = 0; result.solved && k < result.parameters.size(); ++k) {
    const ModelParameter& p = result.parameters.parameters()[k];
    if (!p.is_joint_term) continue;
    list.push_back({{"name", robot.links[p.block].joint.name + "." +
                                 JointTermName(p.term)},
                    {"unit", p.unit},
                    {"value", JsonNumber(result.x[k])},
                    {"stddev", JsonNumber(result.stddev[k])},
                    {"prior", nullptr},
                    {"identifiable", bool(result.identifiable[k])}});
  }
  return list;
}

// `blocks` of `of` is condition (2.30), block by block; `batch` of `total` that
// of all equations at once.
json RankJson(const Robot& robot, const LinearCalibration& result) {
  const Identifiability& id = result.identifiability;
  json unidentifiable = json::array(), blocks = json::array();
  for (const auto& d : id.directions) unidentifiable.push_back(d.text);
  for (const auto& d : id.block_directions) {
    blocks.push_back({{"block", d.block + 1}, {"direction", d.text}});
  }
  json advice = json::array();
  for (const AdvisedMotion& motion : id.advice) {
    json joints = json::array();
    for (const int j : motion.joints) {
      joints.push_back(robot.links[j].joint.name);
    }
    advice.push_back({{"joints", joints}, {"batch", motion.rank}});
  }
  return {{"blocks", id.block_rank},
          {"of", id.block_size},
          {"batch", id.batch_rank},
          {"total", id.total},
          {"unidentifiable", unidentifiable},
          {"block_directions", blocks},
          {"advice", advice}};
}

json GeometryJson(const LinearCalibration& result) {
  json list = json::array();
  for (const RecoveredLength& l : result.lengths) {
    list.push_back({{"name", l.name},
                    {"symbol", l.symbol},
                    {"unit", "m"},
                    {"nominal", l.nominal},
                    {"value", l.identifiable ? JsonNumber(l.value) : nullptr},
                    {"stddev", l.identifiable ? JsonNumber(l.stddev) : nullptr},
                    // What the refined robot has, seen or not.
                    {"used", JsonNumber(l.value)},
                    {"identifiable", l.identifiable}});
  }
  return list;
}

json UnpoweredJson(const Robot& robot, const LogSet& training,
                   const LinearCalibration& result) {
  json list = json::array();
  for (const UnpoweredJoint& u : result.unpowered) {
    list.push_back({{"log", training.path(u.log)},
                    {"joint", robot.links[u.joint].joint.name},
                    {"torque_rms", u.torque_rms}});
  }
  return list;
}

json CovarianceJson(const LinearCalibration& result) {
  json names = json::array(), units = json::array();
  for (const ModelParameter& p : result.parameters.parameters()) {
    names.push_back(p.name);
    units.push_back(p.unit);
  }
  return {{"names", names},
          {"units", units},
          {"file", "covariance.csv"},
          {"method", result.covariance_method}};
}

// The residuals of all joints, and the validation logs they are of.
void AddResiduals(const LogSet* validation, const LinearCalibration& result,
                  json* out) {
  if (result.training) {
    (*out)["excluded_share"] = result.training->excluded_share();
    (*out)["stacked_residual_percent"] =
        JsonNumber(result.training->moving().stacked_percent);
  }
  if (validation != nullptr) (*out)["validation_logs"] = LogsJson(*validation);
  if (result.validation) {
    (*out)["validation_stacked_residual_percent"] =
        JsonNumber(result.validation->moving().stacked_percent);
  }
}

}  // namespace

// What follows from the result alone; the other ToJson adds what is of its
// logs.
json ToJson(const Robot& robot, const LinearCalibration& result) {
  const bool weak = result.rows.identification == Identification::kWeak;
  return {{"format", "armcal calibration 1"},
          {"robot", robot.name},
          {"estimate", "linear"},
          {"solver", SolverName(result.solver)},
          {"trajectory",
           result.encoder_noise.size() > 0 ? "corrected" : "measured"},
          {"bandwidth_hz", result.rows.bandwidth_hz},
          {"friction_bandwidth_hz", FrictionJson(result.friction)},
          {"window_s", weak ? json(result.rows.window_s) : json(nullptr)},
          {"joints", JointsJson(robot, result)},
          {"model_parameters", ModelParametersJson(result)},
          {"parameters", ParametersJson(robot, result)},
          {"merged", result.parameters.merged()},
          {"verdict", VerdictJson(Shortcomings(robot, result))},
          {"warnings", CalibrationWarnings(robot, result)},
          {"rank", RankJson(robot, result)},
          {"geometry", GeometryJson(result)},
          {"covariance", CovarianceJson(result)},
          {"termination",
           {{"converged", result.solved},
            {"reason", result.reason},
            {"iterations", result.passes}}}};
}

json ToJson(const Robot& robot, const LogSet& training,
            const LogSet* validation, const LinearCalibration& result) {
  json out = ToJson(robot, result);
  for (int i = 0; i < robot.num_joints(); ++i) {
    out["joints"][i]["spikes"] = CountOutliers(result, i);
    out["joints"][i]["position_spikes"] =
        i < result.position_spikes.size() ? result.position_spikes[i] : 0;
  }
  out["logs"] = LogsJson(training);
  out["torque"] = training.torque_source();
  out["torque_constants_stddev"] = training.torque_constants_stddev();
  out["unpowered"] = UnpoweredJson(robot, training, result);
  out["outliers"] = OutlierJson(robot, training, result, kListedOutliers);
  out["outlier_count"] = CountOutliers(result);
  AddResiduals(validation, result, &out);
  return out;
}

// Entries of parameters that are not identifiable are empty: they have no
// variance.
std::string CovarianceCsv(const LinearCalibration& result) {
  std::string text;
  for (const ModelParameter& p : result.parameters.parameters()) {
    text += (text.empty() ? "\"" : ",\"") + p.name + "\"";
  }
  text += "\n";
  char number[40];
  for (Eigen::Index r = 0; r < result.covariance.rows(); ++r) {
    for (Eigen::Index c = 0; c < result.covariance.cols(); ++c) {
      const bool seen = result.identifiable[r] && result.identifiable[c];
      std::snprintf(number, sizeof(number), "%.17g", result.covariance(r, c));
      text += std::string(c == 0 ? "" : ",") + (seen ? number : "");
    }
    text += "\n";
  }
  return text;
}

}  // namespace armcal
