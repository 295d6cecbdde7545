#include "model/log_files/log_writer.h"

#include <glog/logging.h>

#include <cstdio>

#include "model/log_files/columns/log_columns.h"
#include "model/log_files/columns/log_signal.h"
#include "model/log_files/columns/wrench_columns.h"

namespace armcal {

namespace {

struct Column {
  Signal signal;
  Eigen::MatrixXd values;  // samples x n, or empty
};

std::vector<Column> Columns(const Log& log, const LogWriterOptions& options) {
  std::vector<Column> columns = {{Signal::kPosition, log.q},
                                 {Signal::kVelocity, log.qd},
                                 {Signal::kAcceleration, log.qdd}};
  if (options.torque_constants.empty()) {
    columns.push_back({Signal::kEffort, log.tau});
    columns.push_back({Signal::kCurrent, log.current});
  } else {
    CHECK_EQ(static_cast<long>(options.torque_constants.size()),
             log.tau.cols());
    const Eigen::Map<const Eigen::RowVectorXd> constants(
        options.torque_constants.data(), log.tau.cols());
    columns.push_back(
        {Signal::kCurrent, log.tau.array().rowwise() / constants.array()});
  }
  columns.push_back({Signal::kReference, log.qref});
  columns.push_back({Signal::kTemperature, log.temperature});
  return columns;
}

}  // namespace

std::string LogText(const Log& log, const LogWriterOptions& options) {
  const std::vector<Column> columns = Columns(log, options);
  std::string text = "t";
  for (const Column& column : columns) {
    for (int j = 0; j < column.values.cols(); ++j) {
      text += "," + std::string(NamesOf(column.signal).number_prefix) +
              std::to_string(j + 1);
    }
  }
  for (int j = 0; j < log.wrench.cols(); ++j) {
    text += std::string(",") + kWrenchNames[j];
  }
  if (log.simulated) text += std::string(",") + LogColumns::kSimulated;
  char number[40];
  const auto add_row = [&](const Eigen::MatrixXd& values, int k) {
    for (int j = 0; j < values.cols(); ++j) {
      text.append(number,
                  std::snprintf(number, sizeof number, ",%.9g", values(k, j)));
    }
  };
  for (int k = 0; k < log.size(); ++k) {
    text += '\n';
    text.append(number, std::snprintf(number, sizeof number, "%.6f", log.t[k]));
    for (const Column& column : columns) add_row(column.values, k);
    add_row(log.wrench, k);
    if (log.simulated) text += ",1";
  }
  return text + "\n";
}

}  // namespace armcal
