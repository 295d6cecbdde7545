#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/log_files/log_topic.h"
#include "model/log_files/row_range.h"

namespace armcal {

// Where the joint torque comes from.
enum class TorqueKind {
  kAuto,     // tau columns; where there are none, currents; else voltages
  kLink,     // tau columns, on the joint side, as they are
  kMotor,    // tau columns on the motor side, times the gear ratio
  kCurrent,  // current columns, times torque constant and gear ratio
  kCommand,  // tau columns that hold commanded torques
  kVoltage,  // motor voltages, times torque per volt and gear ratio
};

// Torques that were reconstructed for a log that has none, N m or N, a row for
// each of the log's, joints in columns.
struct ReconstructedTorque {
  Eigen::MatrixXd tau;
  // What makes them wrong, rows at the times t, s since the log's first row;
  // empty: not known.
  Eigen::VectorXd t;
  Eigen::MatrixXd position_noise;  // one draw of that of the log, rad or m
  Eigen::MatrixXd torque_noise;    // and what it makes of tau, N m or N
  Eigen::MatrixXd by_rate;         // Motion::torque_by_rate, N m or N
  bool drifts = false;             // its level is not known and walks at random
  std::string source;              // what torque_source() says
};

struct LogReaderOptions {
  std::vector<std::string> joint_names;  // the robot's, base to tip
  TorqueKind torque_kind = TorqueKind::kAuto;
  // Efforts without a unit are torques also where `torque_kind` is currents or
  // voltages, which nobody said of this log by name.
  bool efforts_are_torques = false;
  // N m/A per joint, of voltages N m/V at standstill; empty: not given.
  std::vector<double> torque_constants;
  // Relative standard deviation of each joint's torque scale: a factor
  // that is fixed for the robot. Not given: see torque_columns.h.
  std::optional<double> torque_constants_stddev = 0;
  std::vector<double> gear_ratios;  // per joint; empty: 1
  std::vector<LogTopic> topics;     // of a bag (line_source.h)
  bool need_torque = true;
  // Where torque is needed: a log will do that has no torques, nor currents or
  // voltages (nor torque constants for these), but the commands of all joints.
  bool commands_do = false;
  // By path: what such logs have instead.
  std::map<std::string, std::shared_ptr<const ReconstructedTorque>>
      reconstructed_torque;
  // Where torque is needed: a log will do whose motor currents or voltages
  // have no constants. It has no torque then; LogReader names them.
  bool currents_do = false;
  // By path: the time of each row, s since the first, for a log whose stamps
  // are known to be wrong.
  std::map<std::string, std::shared_ptr<const Eigen::VectorXd>> sample_times;
  // By path: rows that are not to be read, as what they have was not measured.
  // Lines of a file that messages name (Log::first_row) count on as if there
  // were none.
  std::map<std::string, std::vector<RowRange>> left_out;
  std::vector<RowRange> LeftOutOf(const std::string& path) const {
    const auto rows = left_out.find(path);
    return rows == left_out.end() ? std::vector<RowRange>() : rows->second;
  }
  // By path: turns that are taken out of positions as they are read.
  std::map<std::string, std::vector<PositionTurn>> position_turns;
  // Columns that are in the log and not wanted are not looked at.
  bool want_velocity = false;
  bool want_acceleration = false;
  bool want_reference = false;
  bool want_temperature = false;
  bool want_wrench = false;   // of a force-torque sensor
  bool want_current = false;  // of motors, beside torques of joint sensors
};

}  // namespace armcal
