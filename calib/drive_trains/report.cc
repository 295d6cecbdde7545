#include "calib/drive_trains/report.h"

#include <cmath>

#include "calib/numerics/json_value.h"
#include "model/dynamics/joint_term.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr const char* kNames[DriveTrain::kUnknowns] = {
    "torque_constant", "armature",         "viscous",
    "coulomb",         "load_coefficient", "offset"};

const char* EffortUnit(const DriveTrain& drive) {
  return drive.type == JointType::kPrismatic ? "N" : "N m";
}

json JointJson(const DriveTrain& drive) {
  json entry = {{"joint", drive.joint},
                {"unit", std::string(EffortUnit(drive)) + "/A"}};
  if (!drive.not_told.empty()) {
    entry["not_told"] = drive.not_told;
    return entry;
  }
  for (int k = 0; k < DriveTrain::kUnknowns; ++k) {
    const std::string name = kNames[k];
    entry[name] = drive.told[k] ? json(drive.value[k]) : json();
    entry[name + "_stddev"] = drive.told[k] ? json(drive.stddev[k]) : json();
  }
  entry["sign_width"] = drive.width;
  entry["residual_rms"] = drive.rms;
  entry["current_rms"] = drive.current;
  return entry;
}

std::string Cell(const DriveTrain& drive, int k) {
  if (!drive.told[k]) return Format("%20s", "-");
  const std::string text =
      Format("%.4g +- %.1g", drive.value[k], drive.stddev[k]);
  return Format("%20s", text.c_str());
}

}  // namespace

json DriveTrainsJson(const DriveTrains& drives) {
  json joints = json::array();
  for (const DriveTrain& drive : drives.joints) {
    joints.push_back(JointJson(drive));
  }
  return {{"samples", drives.samples}, {"joints", joints}};
}

std::string DriveTrainsText(const DriveTrains& drives) {
  if (drives.joints.empty()) return "";
  std::string text = Format(
      "\nbetween motor currents and the log's joint "
      "torques\n%-12s%20s%20s%20s%20s"
      "%20s%10s\n",
      "", "torque per ampere", "armature", "viscous", "coulomb", "of load",
      "left");
  for (const DriveTrain& drive : drives.joints) {
    text += Format("%-12s", drive.joint.c_str());
    if (!drive.not_told.empty()) {
      text += "  not told: " + drive.not_told + "\n";
      continue;
    }
    for (int k = 0; k < DriveTrain::kOffset; ++k) text += Cell(drive, k);
    text += Format("%8.2g %%\n", 100 * drive.rms / drive.current);
  }
  return text;
}

}  // namespace armcal
