#pragma once

#include <memory>
#include <string>

#include "model/log_files/log.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"

namespace armcal {

struct UnscaledDrives;

// Reads a CSV or gzipped CSV log block by block in constant memory, another
// format (open_lines.h) held in it, or one that is in memory.
//
// Header: `t` (or time, timestamp, __time) and per joint either by number
// (1-based) q1 qd1 qdd1 tau1 i1 u1 qref1 temp1 or by name shoulder/position|
// velocity|acceleration|effort|current|voltage|reference|temperature, also with
// a leading path
// (/joint_states/shoulder/position). A unit suffix is honoured: [s] [ms] [us]
// [ns] [rad] [deg] [rad/s] [deg/s] [rad/s^2] [deg/s^2] [m] [mm] [m/s] [mm/s]
// [m/s^2] [mm/s^2] [Nm] [N] [mNm] [kNm] [A] [mA] [V] [mV]; without one the unit
// is SI. An effort in A is a current, in V a voltage. A force-torque sensor has
// six columns (wrench_columns.h). Other spellings are understood, too, where
// time and all positions come out (column_spelling.h). Order never matters,
// names do; columns that are not used are not parsed. Separators , ; or TAB;
// CRLF, a byte order mark, quoted names and a # before the header are accepted.
// Times may be large (epoch): they are kept relative to the first row's without
// loss. Equal times pass.
//
// Throws InputError with file, row, column, value and expectation: a missing or
// duplicate column, a log that numbers more joints than the robot has, a field
// that is not a finite number in a used column, a row with the wrong number of
// fields or none, time running backwards, a truncated or damaged gzip stream, a
// file without rows, torque constants or gear ratios that do not fit. Rows are
// lines of the file, the header is row 1.
class LogReader {
 public:
  LogReader(const LogSource& log, const LogReaderOptions& options);
  ~LogReader();
  LogReader(LogReader&&) noexcept;
  LogReader& operator=(LogReader&&) noexcept;

  bool has_velocity() const;  // a velocity column for every joint
  bool has_acceleration() const;
  bool has_torque() const;   // that is read
  bool has_wrench() const;   // of a force-torque sensor, that is read
  bool has_current() const;  // beside torques, that is read
  // How the torque was made, a phrase for reports: "tau columns" or
  // "currents times 14.87 13.26 N m/A"; empty where it is not needed.
  const std::string& torque_source() const;

  // How the columns are called, where not as here: LogColumns::Spelling().
  std::string spelling() const;

  // Currents or voltages that have no constants; none where torques are read.
  const UnscaledDrives& unscaled_drives() const;

  // Relative standard deviation of its scale, each joint's: as the options say,
  // else 0 for a simulated log and by the torque's kind for any other.
  double torque_constants_stddev() const;

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
Log ReadWholeLog(const LogSource& log, const LogReaderOptions& options);

}  // namespace armcal
