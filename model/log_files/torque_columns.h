#pragma once

#include <string>
#include <vector>

#include "model/log_files/columns/log_columns.h"
#include "model/log_files/log_reader_options.h"

namespace armcal {

// Relative standard deviations of a joint's torque scale where nothing is said.
// Motor currents: makers of servo motors (Kollmorgen, maxon) give torque
// constants to +-10 %, two deviations. Torque sensors, and torques that a drive
// has made of currents with constants that its maker identified: some per cent.
constexpr double kCurrentScaleStddev = .05;
constexpr double kTorqueScaleStddev = .02;
// Voltages: torque per volt is the constant over the winding's resistance.
// Beside the constant's 5 % copper is 6 % more resistant for 15 K (0.39 % / K),
// and as much again may be said of its resistance and of what leads and
// brushes take: sqrt(.05^2 + .06^2 + .06^2).
constexpr double kVoltageScaleStddev = .1;

// The columns that give the joint torque once multiplied by their scale, which
// holds unit, torque constant and gear ratio.
struct TorqueColumns {
  std::vector<LogColumn> columns;
  std::string source;  // what LogReader::torque_source() says
  // How well their scale is known, relative standard deviation.
  double scale_stddev = kTorqueScaleStddev;
};

// Chooses them as `options` ask; `file` is for messages. Throws InputError that
// says which columns or which option is missing.
TorqueColumns FindTorqueColumns(const std::string& file,
                                const LogColumns& columns,
                                const LogReaderOptions& options);

// "its scale known to 5 % (--torque_constants_stddev)", a phrase for reports.
std::string ScaleText(double scale_stddev);

// Whether its torques are those of the joints themselves, for all that the
// options say: of sensors behind the gears, not of motors or commands.
bool HasJointTorques(const LogColumns& columns,
                     const LogReaderOptions& options);

// Whether there is nothing in the log to make a torque of: no torques, and no
// currents or voltages or no constants for them. A part of the joints is no
// nothing.
bool LacksTorque(const LogColumns& columns, const LogReaderOptions& options);

// Columns of currents or voltages that a torque would be made of if there were
// constants for them.
struct UnscaledDrives {
  std::string columns;  // "i1 to i6"; empty: there is nothing to wait for
  std::string what;     // "currents" or "voltages"
  std::string wanted;   // what to give for them, a phrase for messages
};
UnscaledDrives FindUnscaledDrives(const LogColumns& columns,
                                  const LogReaderOptions& options);

// What a JointState's effort is where the torque is of this kind.
Signal EffortIn(TorqueKind kind);

// Throws InputError where torque constants or gear ratios are given and are not
// one non-zero finite number per joint.
void CheckTorqueFactors(const LogReaderOptions& options);

}  // namespace armcal
