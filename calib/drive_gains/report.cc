#include "calib/drive_gains/report.h"

#include <algorithm>

#include "calib/numerics/json_figures.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr char kAxes[] = "xyz";

std::string GainText(const DriveGain& gain) {
  if (!gain.identifiable) return "    not observable";
  return Format("%11.5g +- %-9.3g ", gain.value, gain.stddev) + gain.unit;
}

std::string PayloadText(const DriveGains& result) {
  std::string text = Format("  payload of %.6g kg", result.payload_mass);
  for (size_t k = 0; k < result.com.size(); ++k) {
    const PayloadCoordinate& c = result.com[k];
    text += k == 0 ? ", centre of mass " : ", ";
    text += kAxes[k];
    text += c.identifiable ? Format(" %.4f +- %.2g m", c.value, c.stddev)
                           : std::string(" not seen");
  }
  return text + " in the last link's frame\n";
}

// What the calibration that follows makes of the constants' deviations.
std::string AllowanceText(const DriveGains& result,
                          std::optional<double> given) {
  const std::string option = OptionName("torque_constants_stddev");
  if (given == 0.) {
    return "  what follows takes these constants for exact (" + option +
           " is 0)\n\n";
  }
  if (given) {
    return Format(
               "  what follows allows each joint's torque an error of %.3g "
               "%% (",
               100 * *given) +
           option + ")\n\n";
  }
  return Format(
             "  what follows allows each joint's torque an error of %.3g "
             "%%, that of the least certain constant (%s); ",
             100 * result.LargestRelativeStddev(),
             result.gains[result.LeastCertain()].name.c_str()) +
         option + " says otherwise\n\n";
}

}  // namespace

std::string DriveGainsReport(const DriveGains& result,
                             std::optional<double> given_stddev) {
  size_t width = 20;
  for (const DriveGain& gain : result.gains) {
    width = std::max(width, gain.name.size());
  }
  std::string text = "torque per current, from the known payload\n";
  for (const DriveGain& gain : result.gains) {
    text += "  " + gain.name + std::string(width - gain.name.size() + 1, ' ') +
            GainText(gain) + "\n";
  }
  text += PayloadText(result);
  if (!result.covariance_method.empty()) {
    text += "  standard deviations: " + result.covariance_method + "\n";
  }
  return text + (result.solved ? AllowanceText(result, given_stddev)
                               : "\nnot calibrated: " + result.reason + "\n");
}

void AddDriveGains(const DriveGains& result, json* calibration) {
  json& c = *calibration;
  c["drive_gains"] = json::array();
  for (const DriveGain& gain : result.gains) {
    json entry = {{"name", gain.name},
                  {"unit", gain.unit},
                  {"value", JsonNumber(gain.value)},
                  {"stddev", JsonNumber(gain.stddev)},
                  {"identifiable", gain.identifiable}};
    if (!gain.identifiable) entry["reason"] = gain.reason;
    c["drive_gains"].push_back(entry);
  }
  c["payload"] = {{"mass", result.payload_mass}};
  for (size_t k = 0; k < result.com.size(); ++k) {
    const std::string key = std::string("com_") + kAxes[k];
    c["payload"][key] = JsonNumber(result.com[k].value);
    c["payload"][key + "_stddev"] = JsonNumber(result.com[k].stddev);
  }
  if (result.solved) return;
  c["termination"] = {{"converged", false},
                      {"reason", result.reason},
                      {"iterations", result.passes}};
}

}  // namespace armcal
