#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model/log.h"
#include "model/log_topic.h"

namespace armcal {

// Where the joint torque comes from.
enum class TorqueKind {
  kAuto,     // tau columns; where there are none, currents
  kLink,     // tau columns, on the joint side, as they are
  kMotor,    // tau columns on the motor side, times the gear ratio
  kCurrent,  // current columns, times torque constant and gear ratio
  kCommand,  // tau columns that hold commanded torques
};

// Torques that were made for a log that has none, N m or N, a row for each of
// the log's, joints in columns.
struct MadeTorque {
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
  std::vector<double> torque_constants;  // N m/A per joint; empty: not given
  std::vector<double> gear_ratios;       // per joint; empty: 1
  std::vector<LogTopic> topics;          // of a bag (line_source.h)
  bool need_torque = true;
  // Where torque is needed: a log will do that has neither torques nor currents
  // (nor --torque_constants for these) but the commands of all joints.
  bool commands_do = false;
  // By path: what such logs have instead.
  std::map<std::string, std::shared_ptr<const MadeTorque>> made_torque;
  // Columns that are in the log and not wanted are not looked at.
  bool want_velocity = false;
  bool want_acceleration = false;
  bool want_reference = false;
  bool want_temperature = false;
};

// Reads a CSV or gzipped CSV log block by block in constant memory, or another
// format (line_source.h) held in it.
//
// Header: `t` (or time, timestamp, __time) and per joint either by number
// (1-based) q1 qd1 qdd1 tau1 i1 qref1 temp1 or by name shoulder/position|
// velocity|acceleration|effort|current|reference|temperature, also with a
// leading path
// (/joint_states/shoulder/position). A unit suffix is honoured: [s] [ms] [us]
// [ns] [rad] [deg] [rad/s] [deg/s] [rad/s^2] [deg/s^2] [m] [mm] [m/s] [mm/s]
// [m/s^2] [mm/s^2] [Nm] [N] [mNm] [kNm] [A] [mA]; without one the unit is SI.
// An effort in A is a current. Order never matters, names do; columns that are
// not used are not parsed. Separators , ; or TAB; CRLF, a byte order mark,
// quoted names and a # before the header are accepted. Times may be large
// (epoch): they are kept relative to the first row's without loss. Equal times
// pass.
//
// Throws InputError with file, row, column, value and expectation: a missing or
// duplicate column, a log that numbers more joints than the robot has, a field
// that is not a finite number in a used column, a row with the wrong number of
// fields or none, time running backwards, a truncated or damaged gzip stream, a
// file without rows, torque constants or gear ratios that do not fit. Rows are
// lines of the file, the header is row 1.
class LogReader {
 public:
  LogReader(const std::string& path, const LogReaderOptions& options);
  ~LogReader();
  LogReader(LogReader&&) noexcept;
  LogReader& operator=(LogReader&&) noexcept;

  bool has_velocity() const;  // a velocity column for every joint
  bool has_acceleration() const;
  bool has_torque() const;  // that is read
  // How the torque was made, a phrase for reports: "tau columns" or
  // "currents times 14.87 13.26 N m/A"; empty where it is not needed.
  const std::string& torque_source() const;

  // Reads up to `max_rows` rows into *log (which it overwrites); false and an
  // empty log at the end of the file. The wanted signals that the log lacks
  // stay empty.
  bool Read(int max_rows, Log* log);
  // Starts again at the first row.
  void Rewind();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All rows of a log that has to be in memory as a whole. Throws InputError,
// also for more than 2^20 rows.
Log ReadWholeLog(const std::string& path, const LogReaderOptions& options);

}  // namespace armcal
