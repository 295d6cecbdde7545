#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/inspect/frozen_channels.h"
#include "calib/inspect/log_coverage.h"
#include "calib/inspect/log_drawing.h"
#include "calib/inspect/log_reading.h"
#include "calib/inspect/torque_scale.h"
#include "calib/logs/channel_audit.h"
#include "calib/logs/inspection_finding.h"
#include "calib/logs/position_jumps.h"
#include "calib/logs/sample_clock.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/torque_columns.h"
#include "model/robot/robot.h"

namespace armcal {

// What a log holds and what is wrong with it.
struct LogInspection {
  std::string path;
  int rows = 0;
  bool whole = true;    // false: only the first rows were looked at
  double duration = 0;  // s
  StampFigures stamps;
  SampleClock clock;
  bool rebuilds_time = false;  // the log fits better by the clock's time
  LogJumps jumps;
  std::vector<FrozenChannel> frozen;  // rows that are left out
  std::string spelling;               // LogReader's
  std::string torque_source;          // empty: none, but commands or currents
  UnscaledDrives unscaled;            // currents or voltages without constants
  Eigen::VectorXd travel;             // per joint, rad or m
  Eigen::VectorXd top_speed;          // rad/s or m/s
  // Rms of command minus position, rad or m; empty where no command is logged.
  Eigen::VectorXd tracking_rms;
  TorqueScales torque_scales;   // empty where no torque was read
  double moving_share = 0;      // of the time
  double residual_percent = 0;  // of torques by the best fit of the arm
  std::vector<InspectionFinding> findings;
  bool as_it_is = false;  // its torques fit the robot best as logged
  LogReading reading;
  // Per joint, where positions are in other units: its velocity is not.
  std::vector<bool> velocity_as_it_is;
  LogCoverage coverage;  // CoverageOf, where asked for
  LogDrawing drawing;    // where bins are asked for

  // Whether the best fit explains more of the torque's squares than it leaves.
  bool ExplainsTorque() const {
    return residual_percent * residual_percent < 5000;
  }

  explicit LogInspection(const Robot& robot) : reading(robot) {}
};

constexpr int kMostInspectedRows = 1 << 20;

// Throws InputError for what cannot be read at all. It is drawn in
// `drawn_bins`, 0: not at all. Of a long log the first `most_rows`.
LogInspection InspectLog(const Robot& robot, const LogSource& log,
                         const LogReaderOptions& options, int drawn_bins = 0,
                         int most_rows = kMostInspectedRows);

// The log as the reading has it, with its time in s, or the clock's time, and
// without what of its jumps can be mended.
Log Mended(const Robot& robot, const Log& recorded,
           const LogInspection& inspection);

}  // namespace armcal
