#include "calib/nonlinear_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "calib/json_figures.h"

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
          {"held", p.held}};
}

// Text in a column of this width; longer text makes the row longer.
std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

template <typename... Args>
std::string Format(const char* format, Args... args) {
  char text[128];
  std::snprintf(text, sizeof(text), format, args...);
  return text;
}

constexpr size_t kValueWidth = 22;

// "12.3 +- 0.4", or "12.3 (prior)" where the logs do not tell.
std::string Value(const PhysicalParameter& p) {
  const std::string value = Format("%9.4g ", p.value);
  return Padded(value + (p.held           ? "(held)"
                         : p.identifiable ? Format("+- %.2g", p.stddev)
                                          : "(prior)"),
                kValueWidth);
}

const PhysicalParameter* Find(const NonlinearCalibration& result,
                              const std::string& name) {
  for (const PhysicalParameter& p : result.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

std::string Percent(const TorqueResidual& residual) {
  const double percent = residual.moving().stacked_percent;
  return std::isfinite(percent) ? Format("%.2f %%", percent)
                                : "unknown (no torque)";
}

bool Converged(const NonlinearCalibration& result) {
  return result.reason == "CONVERGENCE";
}

std::string LinkTable(const Robot& nominal, const Robot& robot) {
  const std::string title = "robot for a simulator";
  size_t width = title.size() + 1;
  for (const Link& link : robot.links) {
    width = std::max(width, link.name.size() + 3);
  }
  std::string text = "\n" + Padded(title, width) +
                     "  mass kg    (file)   centre of mass x, y, z m\n";
  for (size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const Eigen::Vector3d com = link.inertial.first_moment / link.inertial.mass;
    text += Padded("  " + link.name, width) +
            Format("%9.3f ", link.inertial.mass) +
            Format("%9s",
                   Format("(%.3f)", nominal.links[i].inertial.mass).c_str()) +
            Format("   %9.4f %9.4f %9.4f\n", com.x(), com.y(), com.z());
  }
  return text;
}

std::string JointTable(const NonlinearCalibration& result) {
  size_t width = 8;
  for (const Link& link : result.robot.links) {
    width = std::max(width, link.joint.name.size() + 3);
  }
  const std::vector<std::string> terms = {"viscous", "coulomb", "armature"};
  std::string text = "\n" + Padded("  joint", width);
  for (const auto& term : terms) text += Padded("  " + term, kValueWidth);
  for (const Link& link : result.robot.links) {
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n" + Padded("  " + link.joint.name, width);
    for (const auto& term : terms) {
      text += Value(*Find(result, link.joint.name + "." + term));
    }
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

}  // namespace

std::string NonlinearReport(const Robot& nominal,
                            const NonlinearCalibration& result) {
  if (!result.solved) {
    return "\nno physically consistent robot: " + result.reason + "\n";
  }
  std::string text = LinkTable(nominal, result.robot) + JointTable(result) +
                     "\nresidual of this robot " + Percent(*result.training);
  if (result.validation) text += ", held out " + Percent(*result.validation);
  if (!Converged(result)) {
    text += "\nnot converged: " + result.reason + " after " +
            std::to_string(result.iterations) + " iterations";
  }
  return text + "\n";
}

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
  c["parameters"] = json::array();
  json names = json::array(), units = json::array();
  for (const PhysicalParameter& p : result.parameters) {
    c["parameters"].push_back(ParameterJson(p));
    names.push_back(p.name);
    units.push_back(p.unit);
  }
  c["parameters_covariance"] = {{"names", names},
                                {"units", units},
                                {"file", "parameters_covariance.csv"}};
  c["refined"] = {{"converged", Converged(result)},
                  {"reason", result.reason},
                  {"iterations", result.iterations}};
}

std::string ParametersCovarianceCsv(const NonlinearCalibration& result) {
  std::string text;
  for (const PhysicalParameter& p : result.parameters) {
    text += (text.empty() ? "\"" : ",\"") + p.name + "\"";
  }
  text += "\n";
  char number[40];
  for (size_t r = 0; r < result.parameters.size(); ++r) {
    for (size_t k = 0; k < result.parameters.size(); ++k) {
      if (k > 0) text += ",";
      if (!result.parameters[r].identifiable ||
          !result.parameters[k].identifiable) {
        continue;
      }
      std::snprintf(number, sizeof(number), "%.17g", result.covariance(r, k));
      text += number;
    }
    text += "\n";
  }
  return text;
}

}  // namespace armcal
