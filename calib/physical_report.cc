#include "calib/physical_report.h"

#include <cmath>
#include <cstdio>

namespace armcal {
namespace {

using nlohmann::json;

json Number(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

void SetFigures(const TorqueResidual& residual, const std::string& prefix,
                int joint, json* entry) {
  const auto moving = residual.moving(), whole = residual.whole();
  (*entry)[prefix + "residual_rms"] = Number(moving.residual_rms[joint]);
  (*entry)[prefix + "residual_percent"] = Number(moving.percent[joint]);
  (*entry)[prefix + "whole_log_residual_rms"] =
      Number(whole.residual_rms[joint]);
  (*entry)[prefix + "whole_log_residual_percent"] =
      Number(whole.percent[joint]);
}

json ParameterJson(const PhysicalParameter& p) {
  return {{"name", p.name},
          {"unit", p.unit},
          {"value", Number(p.value)},
          {"stddev", Number(p.stddev)},
          {"prior", Number(p.prior)},
          {"identifiable", p.identifiable},
          {"held", p.held}};
}

// "12.3 +- 0.4", or "12.3 (by the robot file)" where the logs do not tell.
std::string Value(const PhysicalParameter& p) {
  char text[64];
  if (p.identifiable) {
    std::snprintf(text, sizeof(text), "%9.4g +- %-8.2g", p.value, p.stddev);
  } else {
    std::snprintf(text, sizeof(text), "%9.4g %-11s", p.value, "(prior)");
  }
  return text;
}

const PhysicalParameter* Find(const PhysicalCalibration& result,
                              const std::string& name) {
  for (const PhysicalParameter& p : result.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

}  // namespace

std::string PhysicalReport(const Robot& nominal,
                           const PhysicalCalibration& result) {
  if (!result.solved) {
    return "\nno physically consistent robot: " + result.reason + "\n";
  }
  char line[256];
  std::string text =
      "\nrobot for a simulator          mass kg (file)     centre of mass m\n";
  for (size_t i = 0; i < result.robot.links.size(); ++i) {
    const Link& link = result.robot.links[i];
    const Eigen::Vector3d com = link.inertial.first_moment / link.inertial.mass;
    std::snprintf(line, sizeof(line),
                  "  %-24s %8.3f (%.3f)   %8.4f %8.4f %8.4f\n",
                  link.name.c_str(), link.inertial.mass,
                  nominal.links[i].inertial.mass, com.x(), com.y(), com.z());
    text += line;
  }
  text +=
      "\n  joint                 viscous               coulomb               "
      "armature\n";
  for (const Link& link : result.robot.links) {
    text +=
        "  " + link.joint.name +
        std::string(std::max<size_t>(
                        1, 20 - std::min<size_t>(19, link.joint.name.size())),
                    ' ');
    for (const char* term : {".viscous", ".coulomb", ".armature"}) {
      text += Value(*Find(result, link.joint.name + term)) + " ";
    }
    text += "\n";
  }
  std::snprintf(line, sizeof(line), "\nresidual of this robot %.2f %%",
                result.training->moving().stacked_percent);
  text += line;
  if (result.validation) {
    std::snprintf(line, sizeof(line), ", held out %.2f %%",
                  result.validation->moving().stacked_percent);
    text += line;
  }
  return text + "\n";
}

void AddRefined(const PhysicalCalibration& result, json* calibration) {
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
    SetFigures(*result.training, "", static_cast<int>(i), &c["joints"][i]);
    if (!result.validation) continue;
    SetFigures(*result.validation, "validation_", static_cast<int>(i),
               &c["joints"][i]);
  }
  c["stacked_residual_percent"] =
      Number(result.training->moving().stacked_percent);
  if (result.validation) {
    c["validation_stacked_residual_percent"] =
        Number(result.validation->moving().stacked_percent);
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
  c["refined"] = {{"converged", true},
                  {"reason", result.reason},
                  {"iterations", result.iterations}};
}

std::string ParametersCovarianceCsv(const PhysicalCalibration& result) {
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
