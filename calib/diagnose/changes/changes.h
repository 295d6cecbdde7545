#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/changes/hypotheses.h"
#include "calib/diagnose/changes/search.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

// Fewer tell no change from what logs differ by anyway.
inline constexpr int kFewestLogsOfChanges = 4;

// A parameter over the logs.
struct ParameterSeries {
  std::string name;
  std::string unit;
  int joint = 0;
  bool is_joint_term = false;
  Eigen::VectorXd value, stddev;  // of each log alone; infinite: not seen
  Eigen::VectorXd model;          // with the changes
  double scatter = 0;  // by which logs differ given them, standard deviation
};

struct NamedChange {
  NamedHypothesis what;
  FoundChange found;
  std::string place;    // the joint's name, or the link's; empty: all
  std::string reading;  // what makes such changes as a rule
  // Amounts, NamedHypothesis::names.
  Eigen::VectorXd value, stddev;
  // Of each amount: relative to the parameter in the first log; NaN where that
  // is not meant. Of factors, the factor.
  std::vector<double> relative;
  std::vector<bool> seen;           // whether the logs tell the amount
  std::vector<std::string> rivals;  // likelier than 2 %
  std::vector<double> rival_probability;
};

// Which parameters changed when, in logs of one robot over days or weeks.
struct LogChanges {
  std::string refusal;  // why it cannot be told; empty: it was
  std::vector<std::string> logs;
  std::vector<NamedChange> changes;  // steps and drifts
  // What single logs differ by: their motion, a day, or in the first and the
  // last log a change as well.
  std::vector<NamedChange> single_logs;
  // What goes with how the robot moved, or may do so: the amounts of kMotion
  // are those of a motion with e times as much of the measure. Logs in the
  // order of their speed cannot tell that from a drift.
  std::vector<NamedChange> with_motion;
  std::vector<ParameterSeries> parameters;
  // By which logs differ given the changes, relative, all joints together.
  double viscous_scatter = 0, coulomb_scatter = 0;
  double inflation = 1;  // Scatter::inflation
};

// In the order of the logs, each counted as one step of time.
LogChanges FindLogChanges(const Robot& robot, const LogSeries& series);
LogChanges FindLogChanges(const Robot& robot,
                          const std::vector<LogSource>& logs,
                          const LogReaderOptions& reading,
                          const TimeRange& crop,
                          std::optional<double> bandwidth_hz,
                          const Progress& progress);

}  // namespace armcal
