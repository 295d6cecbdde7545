#include "model/log_files/torque_columns.h"

#include <cmath>

#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// "14.87 13.26 9.3"
std::string FormatAll(const std::vector<double>& values) {
  std::string text;
  for (double value : values)
    text += (text.empty() ? "" : " ") + NumberText(value);
  return text;
}

void CheckFactors(const std::string& option, const std::vector<double>& factors,
                  const std::vector<std::string>& joints) {
  if (factors.empty()) return;
  if (factors.size() != joints.size()) {
    throw InputError("", OptionName(option), FormatAll(factors),
                     "expected one value per joint, the robot has " +
                         std::to_string(joints.size()));
  }
  for (size_t i = 0; i < factors.size(); ++i) {
    if (std::isfinite(factors[i]) && factors[i] != 0) continue;
    throw InputError("", OptionName(option) + ", joint " + joints[i],
                     NumberText(factors[i]),
                     "expected a finite number other than 0");
  }
}

void MultiplyBy(const std::vector<double>& factors,
                std::vector<LogColumn>* columns) {
  for (size_t i = 0; i < factors.size(); ++i) (*columns)[i].scale *= factors[i];
}

TorqueColumns FromCurrents(const LogColumns& columns,
                           const LogReaderOptions& options) {
  const bool efforts = columns.HasAny(Signal::kEffort);
  TorqueColumns torque;
  torque.columns = columns.Find(
      Signal::kCurrent,
      efforts ? "; where effort columns hold currents, say so with [A]" : "");
  MultiplyBy(options.torque_constants, &torque.columns);
  MultiplyBy(options.gear_ratios, &torque.columns);
  torque.scale_stddev = kCurrentScaleStddev;
  torque.source =
      "currents times " + FormatAll(options.torque_constants) + " N m/A";
  if (!options.gear_ratios.empty()) {
    torque.source += " times gear ratios " + FormatAll(options.gear_ratios);
  }
  return torque;
}

TorqueColumns FromMotorTorques(const LogColumns& columns,
                               const LogReaderOptions& options) {
  TorqueColumns torque{columns.Find(Signal::kEffort), "motor-side tau columns"};
  MultiplyBy(options.gear_ratios, &torque.columns);
  torque.source += options.gear_ratios.empty()
                       ? " (gear ratio 1)"
                       : " times gear ratios " + FormatAll(options.gear_ratios);
  return torque;
}

// The kind that kAuto stands for.
TorqueKind ChooseKind(const std::string& file, const LogColumns& columns,
                      const LogReaderOptions& options) {
  if (columns.HasAll(Signal::kEffort)) return TorqueKind::kLink;
  if (columns.HasAll(Signal::kCurrent)) return TorqueKind::kCurrent;
  // Incomplete columns: Find() will say which are missing.
  if (columns.HasAny(Signal::kEffort)) return TorqueKind::kLink;
  if (columns.HasAny(Signal::kCurrent)) return TorqueKind::kCurrent;
  std::string instead = "; or currents (i1 or " + options.joint_names[0] +
                        "/current, ..) with " + OptionName("torque_constants");
  if (columns.HasAll(Signal::kReference)) {
    instead += "; or " + OptionName("controller") +
               ", under which calibrate and verify simulate how the "
               "log's commands (qref) are followed";
  }
  throw InputError(file, "row 1", "",
                   "no torque: missing " + columns.Missing(Signal::kEffort) +
                       instead + columns.Unrecognised());
}

// Says so where constants are given that currents would need.
TorqueColumns FromTorques(const LogColumns& columns,
                          const LogReaderOptions& options) {
  return {columns.Find(Signal::kEffort),
          options.torque_constants.empty()
              ? "tau columns"
              : "tau columns (the torque constants are not used)"};
}

}  // namespace

void CheckTorqueFactors(const LogReaderOptions& options) {
  CheckFactors("torque_constants", options.torque_constants,
               options.joint_names);
  CheckFactors("gear_ratios", options.gear_ratios, options.joint_names);
}

std::string ScaleText(double scale_stddev) {
  if (scale_stddev == 0) return "its scale taken as exact";
  return Format("its scale known to %.3g %% (", 100 * scale_stddev) +
         OptionName("torque_constants_stddev") + ")";
}

bool LacksTorque(const LogColumns& columns, const LogReaderOptions& options) {
  if (columns.HasAny(Signal::kEffort)) return false;
  return !columns.HasAny(Signal::kCurrent) || options.torque_constants.empty();
}

std::string CurrentsWithoutConstants(const LogColumns& columns,
                                     const LogReaderOptions& options) {
  const bool wants_currents = options.torque_kind == TorqueKind::kCurrent ||
                              (options.torque_kind == TorqueKind::kAuto &&
                               !columns.HasAny(Signal::kEffort));
  if (!wants_currents || !options.torque_constants.empty() ||
      !columns.HasAll(Signal::kCurrent)) {
    return "";
  }
  return columns.Named(Signal::kCurrent);
}

std::string ConstantsWanted() {
  return OptionName("torque_constants") +
         "=K1,.. in N m/A, one per joint, or " + OptionName("payload_mass") +
         " and " + OptionName("payload_log") + " to estimate them";
}

TorqueColumns FindTorqueColumns(const std::string& file,
                                const LogColumns& columns,
                                const LogReaderOptions& options) {
  const TorqueKind kind = options.torque_kind == TorqueKind::kAuto
                              ? ChooseKind(file, columns, options)
                              : options.torque_kind;
  switch (kind) {
    case TorqueKind::kMotor:
      return FromMotorTorques(columns, options);
    case TorqueKind::kCommand:
      return {columns.Find(Signal::kEffort), "commanded tau columns"};
    case TorqueKind::kCurrent:
      if (options.torque_constants.empty()) {
        const std::string names = columns.Named(Signal::kCurrent);
        throw InputError(file, "", "",
                         "the torque comes from currents" +
                             (names.empty() ? "" : " (" + names + ")") +
                             ", its scale is not observable from them alone: "
                             "expected " +
                             ConstantsWanted());
      }
      return FromCurrents(columns, options);
    default:
      return FromTorques(columns, options);
  }
}

}  // namespace armcal
