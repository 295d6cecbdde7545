#include "model/log_files/torque_columns.h"

#include <cmath>
#include <string_view>

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

// What drives a motor, and becomes its torque by a constant.
struct Drive {
  Signal signal;
  std::string what;     // "currents"
  std::string unit;     // "A"
  double scale_stddev;  // relative
};

// Of a current the torque is K_t i. Of a voltage it is, without the winding's
// inductance (a millisecond and less),
//   tau = K_t / R u - K_t^2 / R qd,
// the second term, the back-EMF's, being a part of the joint's viscous
// friction: a model with that needs the first term only.
Drive DriveOf(TorqueKind kind) {
  if (kind == TorqueKind::kVoltage) {
    return {Signal::kVoltage, "voltages", "V", kVoltageScaleStddev};
  }
  return {Signal::kCurrent, "currents", "A", kCurrentScaleStddev};
}

// What to give for what drives the motors. A known payload tells the scale of
// currents only.
std::string ConstantsWanted(const Drive& drive) {
  std::string wanted = OptionName("torque_constants") + "=K1,.. in N m/" +
                       drive.unit + ", one per joint";
  if (drive.signal == Signal::kCurrent) {
    wanted += ", or " + OptionName("payload_mass") + " and " +
              OptionName("payload_log") + " to estimate them";
  }
  return wanted;
}

// Whether the header gives an effort's unit, which is that of a torque then.
bool SaysItIsTorque(const LogColumns& columns) {
  for (const LogColumn& column : columns.Find(Signal::kEffort)) {
    std::string_view unit;
    SplitUnit(columns.name(column.index), &unit);
    if (!unit.empty() || column.scale != 1) return true;
  }
  return false;
}

// Where the log has what drives its motors. Drivers of servos report it as
// efforts: where the log has no columns of its own for it, and who asks for it
// by name, not the header, says what the efforts are, it is these.
Signal ColumnsOf(const Drive& drive, const LogColumns& columns,
                 const LogReaderOptions& options) {
  const bool is_effort =
      options.torque_kind != TorqueKind::kAuto &&
      !options.efforts_are_torques && !columns.HasAny(drive.signal) &&
      columns.HasAll(Signal::kEffort) && !SaysItIsTorque(columns);
  return is_effort ? Signal::kEffort : drive.signal;
}

TorqueColumns FromDrives(const Drive& drive, const LogColumns& columns,
                         const LogReaderOptions& options) {
  const Signal signal = ColumnsOf(drive, columns, options);
  const bool torques =
      signal != Signal::kEffort && columns.HasAll(Signal::kEffort);
  TorqueColumns torque;
  torque.columns = columns.Find(
      signal, torques ? "; where effort columns hold " + drive.what +
                            ", say so with [" + drive.unit + "]"
                      : "");
  MultiplyBy(options.torque_constants, &torque.columns);
  MultiplyBy(options.gear_ratios, &torque.columns);
  torque.scale_stddev = drive.scale_stddev;
  torque.source =
      drive.what + (signal == Signal::kEffort ? " in tau columns" : "") +
      " times " + FormatAll(options.torque_constants) + " N m/" + drive.unit;
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
  if (columns.HasAll(Signal::kVoltage)) return TorqueKind::kVoltage;
  // Incomplete columns: Find() will say which are missing.
  if (columns.HasAny(Signal::kEffort)) return TorqueKind::kLink;
  if (columns.HasAny(Signal::kCurrent)) return TorqueKind::kCurrent;
  if (columns.HasAny(Signal::kVoltage)) return TorqueKind::kVoltage;
  std::string instead = "; or currents (i1 or " + options.joint_names[0] +
                        "/current, ..) or voltages (u1, ..) with " +
                        OptionName("torque_constants");
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
  const bool has_drives =
      columns.HasAny(Signal::kCurrent) || columns.HasAny(Signal::kVoltage);
  return !has_drives || options.torque_constants.empty();
}

bool HasJointTorques(const LogColumns& columns,
                     const LogReaderOptions& options) {
  return columns.HasAll(Signal::kEffort) &&
         (options.torque_kind == TorqueKind::kAuto ||
          options.torque_kind == TorqueKind::kLink);
}

UnscaledDrives FindUnscaledDrives(const LogColumns& columns,
                                  const LogReaderOptions& options) {
  if (!options.torque_constants.empty()) return {};
  for (const TorqueKind kind : {TorqueKind::kCurrent, TorqueKind::kVoltage}) {
    const bool wanted = options.torque_kind == kind ||
                        (options.torque_kind == TorqueKind::kAuto &&
                         !columns.HasAny(Signal::kEffort));
    const Drive drive = DriveOf(kind);
    if (!wanted) continue;
    const Signal signal = ColumnsOf(drive, columns, options);
    if (columns.HasAll(signal)) {
      return {columns.Named(signal), drive.what, ConstantsWanted(drive)};
    }
  }
  return {};
}

Signal EffortIn(TorqueKind kind) {
  const bool is_drive =
      kind == TorqueKind::kCurrent || kind == TorqueKind::kVoltage;
  return is_drive ? DriveOf(kind).signal : Signal::kEffort;
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
    case TorqueKind::kVoltage: {
      const Drive drive = DriveOf(kind);
      if (!options.torque_constants.empty()) {
        return FromDrives(drive, columns, options);
      }
      const std::string names =
          columns.Named(ColumnsOf(drive, columns, options));
      throw InputError(file, "", "",
                       "the torque comes from " + drive.what +
                           (names.empty() ? "" : " (" + names + ")") +
                           ", its scale is not observable from them alone: "
                           "expected " +
                           ConstantsWanted(drive));
    }
    default:
      return FromTorques(columns, options);
  }
}

}  // namespace armcal
