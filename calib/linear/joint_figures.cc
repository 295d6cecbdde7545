#include "calib/linear/joint_figures.h"

#include "calib/numerics/json_figures.h"

namespace armcal {

void SetJointFigures(const TorqueResidual& residual, const std::string& prefix,
                     int joint, nlohmann::json* entry) {
  const auto moving = residual.moving(), whole = residual.whole();
  (*entry)[prefix + "residual_rms"] = JsonNumber(moving.residual_rms[joint]);
  (*entry)[prefix + "residual_percent"] = JsonNumber(moving.percent[joint]);
  (*entry)[prefix + "torque_rms"] = JsonNumber(moving.torque_rms[joint]);
  (*entry)[prefix + "whole_log_residual_rms"] =
      JsonNumber(whole.residual_rms[joint]);
  (*entry)[prefix + "whole_log_residual_percent"] =
      JsonNumber(whole.percent[joint]);
}

}  // namespace armcal
