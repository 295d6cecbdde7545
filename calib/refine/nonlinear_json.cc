#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "calib/linear/joint_figures.h"
#include "calib/numerics/json_figures.h"
#include "calib/refine/nonlinear_report.h"

namespace armcal {
namespace {

using nlohmann::json;

json ParameterJson(const PhysicalParameter& p) {
  return {{"name", p.name},
          {"unit", p.unit},
          {"value", JsonNumber(p.value)},
          {"stddev", JsonNumber(p.stddev)},
          {"prior", JsonNumber(p.prior)},
          {"identifiable", p.identifiable},
          {"held", p.held},
          {"at_bound", p.at_bound}};
}

// Geometry, poses and correlations in calibration.json.
void AddGeometry(const NonlinearCalibration& result, json* calibration) {
  json& c = *calibration;
  json geometry = json::array();
  for (const PhysicalParameter& p : result.parameters) {
    if (!p.geometry) continue;
    geometry.push_back({{"name", p.name},
                        {"unit", p.unit},
                        {"nominal", p.prior},
                        {"value", JsonNumber(p.value)},
                        {"stddev", JsonNumber(p.stddev)},
                        {"identifiable", p.identifiable}});
  }
  if (!geometry.empty()) {
    if (c.contains("geometry")) c["linear"]["geometry"] = c["geometry"];
    // Lengths that the linear calibration recovered are this robot's too.
    if (result.lengths.empty()) c["geometry"] = json::array();
    for (const json& entry : geometry) c["geometry"].push_back(entry);
  }
  if (result.poses) {
    c["poses"] = {{"unit", "m"},
                  {"rms", result.poses->rms},
                  {"max", result.poses->max},
                  {"before_rms", result.poses->before_rms},
                  {"noise_stddev", result.poses->noise.position}};
  }
}

json CorrelationsJson(const NonlinearCalibration& result) {
  json list = json::array();
  for (const Correlation& r : StrongCorrelations(result)) {
    list.push_back(
        {{"parameters",
          {result.parameters[r.a].name, result.parameters[r.b].name}},
         {"value", r.value}});
  }
  return list;
}

// The covariance of the parameters that are `written`, below their names;
// fields of others are empty.
std::string MatrixCsv(const NonlinearCalibration& result,
                      const std::function<bool(size_t)>& written) {
  std::string text;
  for (const PhysicalParameter& p : result.parameters) {
    text += (text.empty() ? "\"" : ",\"") + p.name + "\"";
  }
  text += "\n";
  char number[40];
  for (size_t r = 0; r < result.parameters.size(); ++r) {
    for (size_t k = 0; k < result.parameters.size(); ++k) {
      if (k > 0) text += ",";
      if (!written(r) || !written(k)) continue;
      std::snprintf(number, sizeof(number), "%.17g", result.covariance(r, k));
      text += number;
    }
    text += "\n";
  }
  return text;
}

}  // namespace

// Beyond 0.9 in size, deviations of single parameters say little: what the data
// tell is a combination of both.
std::vector<Correlation> StrongCorrelations(
    const NonlinearCalibration& result) {
  constexpr double kStrong = 0.9;
  const Eigen::MatrixXd& C = result.covariance;
  std::vector<Correlation> strong;
  for (size_t a = 0; a < result.parameters.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (!result.parameters[a].identifiable) continue;
      if (!result.parameters[b].identifiable) continue;
      const double r = C(a, b) / std::sqrt(C(a, a) * C(b, b));
      if (std::abs(r) >= kStrong) strong.push_back({b, a, r});
    }
  }
  std::stable_sort(strong.begin(), strong.end(),
                   [](const Correlation& x, const Correlation& y) {
                     return std::abs(x.value) > std::abs(y.value);
                   });
  return strong;
}

void AddParameters(const NonlinearCalibration& result, json* calibration) {
  json& c = *calibration;
  c["parameters"] = json::array();
  json names = json::array(), units = json::array();
  for (const PhysicalParameter& p : result.parameters) {
    c["parameters"].push_back(ParameterJson(p));
    names.push_back(p.name);
    units.push_back(p.unit);
  }
  c["parameters_covariance"] = {{"names", names},
                                {"units", units},
                                {"file", "parameters_covariance.csv"},
                                {"posterior_file", "parameters_posterior.csv"},
                                {"correlations", CorrelationsJson(result)},
                                {"unidentifiable", result.unseen}};
}

// Keys of the linear estimate that the refined one has anew move under
// "linear", so that a reader of "joints" or "parameters" always has the
// estimate that is named.
void AddRefined(const NonlinearCalibration& result, json* calibration) {
  json& c = *calibration;
  if (!result.solved) {
    c["refined"] = {{"converged", false}, {"reason", result.reason}};
    return;
  }
  c["linear"] = {{"joints", c["joints"]}, {"parameters", c["parameters"]}};
  for (const char* key :
       {"stacked_residual_percent", "validation_stacked_residual_percent"}) {
    if (c.contains(key)) c["linear"][key] = c[key];
  }
  c["estimate"] = "refined";
  for (size_t i = 0; i < result.robot.links.size(); ++i) {
    SetJointFigures(*result.training, "", static_cast<int>(i), &c["joints"][i]);
    if (!result.validation) continue;
    SetJointFigures(*result.validation, "validation_", static_cast<int>(i),
                    &c["joints"][i]);
  }
  c["stacked_residual_percent"] =
      JsonNumber(result.training->moving().stacked_percent);
  if (result.validation) {
    c["validation_stacked_residual_percent"] =
        JsonNumber(result.validation->moving().stacked_percent);
  }
  AddParameters(result, calibration);
  AddGeometry(result, calibration);
  c["refined"] = {{"converged", result.converged()},
                  {"reason", result.reason},
                  {"iterations", result.iterations}};
}

std::string ParametersCovarianceCsv(const NonlinearCalibration& result) {
  return MatrixCsv(result, [&result](size_t k) {
    return result.parameters[k].identifiable;
  });
}

std::string ParametersPosteriorCsv(const NonlinearCalibration& result) {
  return MatrixCsv(result, [](size_t) { return true; });
}

}  // namespace armcal
