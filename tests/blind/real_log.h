#pragma once

#include <string>
#include <vector>

#include "model/log_files/log.h"
#include "model/log_files/time_base.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/model_residual.h"

namespace armcal {

// A log of a real robot in shared/data, and one of the same robot from before.
struct RealLog {
  std::string arm;    // folder in shared/data
  std::string robot;  // file in it
  std::string log;    // files in it
  TimeRange span;     // of the log, s
  std::string reference;
  TimeRange reference_span;
  std::vector<double> torque_constants;  // N m/A; empty: torques are recorded
  std::vector<std::string> flags;        // what a diagnosis is told besides
  std::string name() const;              // "ur10e_free/id_30s", for labels
};
// Logs in which nothing was changed on purpose since their reference. Those of
// the two sets are of different robots.
const std::vector<RealLog>& RealLogs(BlindSet set);

// All rows of a log within a span, with velocities. Throws InputError.
Log ReadRealLog(const std::string& path, const TimeRange& span,
                const std::vector<std::string>& joint_names,
                const std::vector<double>& torque_constants);

// Rate of uniform logs below, Hz.
inline constexpr double kUniformRateHz = 100;
// The same log at equal steps; what is faster than half of that is low-passed.
Log UniformLog(const Log& log);
// Motion of a uniform log, by its own stamps, low-passed at 10 Hz: encoders of
// 0.1 mrad say no more.
PlantMotion RealMotion(const Log& uniform);
// Column x of samples at times t, at other times; both rise.
Eigen::MatrixXd Interpolate(const Eigen::VectorXd& t, const Eigen::MatrixXd& x,
                            const Eigen::VectorXd& at);

}  // namespace armcal
