#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/log.h"

namespace armcal {

// Where the joint torque comes from.
enum class TorqueKind {
  kAuto,     // tau columns; where there are none, currents
  kLink,     // tau columns, on the joint side, as they are
  kMotor,    // tau columns on the motor side, times the gear ratio
  kCurrent,  // current columns, times torque constant and gear ratio
  kCommand,  // tau columns that hold commanded torques
};

struct LogReaderOptions {
  std::vector<std::string> joint_names;  // the robot's, base to tip
  TorqueKind torque_kind = TorqueKind::kAuto;
  std::vector<double> torque_constants;  // N m/A per joint; empty: not given
  std::vector<double> gear_ratios;       // per joint; empty: 1
  bool need_torque = true;
};

// Reads a CSV or gzipped CSV log block by block in constant memory.
//
// Header: `t` (or time, timestamp) and per joint either by number (1-based)
// q1 qd1 qdd1 tau1 i1 or by name shoulder/position|velocity|acceleration|
// effort|current, also with a leading path (/joint_states/shoulder/position).
// A unit suffix is honoured: [s] [ms] [us] [ns] [rad] [deg] [rad/s] [deg/s]
// [m] [mm] [Nm] [N] [mNm] [A] [mA]. Order never matters, names do; columns that
// are not used are not parsed. Separators , ; or TAB; CRLF and a byte order
// mark are accepted. Times may be large (epoch): they are kept relative to the
// first row's without loss.
//
// Throws InputError with file, row, column, value and expectation: a missing or
// duplicate column, a field that is not a finite number in a used column, a row
// with the wrong number of fields, time running backwards, a truncated or
// damaged gzip stream, an empty file.
class LogReader {
 public:
  LogReader(const std::string& path, const LogReaderOptions& options);
  ~LogReader();
  LogReader(LogReader&&) noexcept;

  bool has_velocity() const;  // a velocity column for every joint
  bool has_acceleration() const;
  // How the torque was made, a phrase for reports: "tau columns" or
  // "currents times 14.87 13.26 ... N m/A".
  const std::string& torque_source() const;

  // Reads up to `max_rows` rows into *log (which it overwrites); false and an
  // empty log at the end of the file.
  bool Read(int max_rows, Log* log);
  // Starts again at the first row.
  void Rewind();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armcal
