#include "model/log_files/log_source.h"

#include <utility>

#include "model/log_files/columns/wrench_columns.h"

namespace armcal {
namespace {

// Nothing where the log has no such signal.
void AddSignal(const char* name, const Eigen::MatrixXd& values,
               std::vector<LogArray>* arrays) {
  if (values.size() == 0) return;
  LogArray array;
  array.name = name;
  array.kind = 'f';
  array.item = sizeof(double);
  array.by_column = true;  // as Eigen has it
  array.rows = values.rows();
  array.columns = values.cols();
  array.bytes.assign(reinterpret_cast<const char*>(values.data()),
                     sizeof(double) * static_cast<size_t>(values.size()));
  arrays->push_back(std::move(array));
}

std::vector<LogArray> ArraysOf(const Log& log) {
  std::vector<LogArray> arrays;
  AddSignal("t", log.t, &arrays);
  AddSignal("q", log.q, &arrays);
  AddSignal("qd", log.qd, &arrays);
  AddSignal("qdd", log.qdd, &arrays);
  AddSignal("tau", log.tau, &arrays);
  AddSignal("qref", log.qref, &arrays);
  AddSignal("temp", log.temperature, &arrays);
  AddSignal(kWrenchArray, log.wrench, &arrays);
  AddSignal("i", log.current, &arrays);
  return arrays;
}

}  // namespace

LogSource::LogSource(std::string name_in, std::vector<LogArray> arrays_in)
    : name(std::move(name_in)),
      arrays(
          std::make_shared<const std::vector<LogArray>>(std::move(arrays_in))) {
}

LogSource::LogSource(std::string name_in, const Log& log)
    : LogSource(std::move(name_in), ArraysOf(log)) {}

std::vector<LogSource> LogFiles(const std::vector<std::string>& paths) {
  return {paths.begin(), paths.end()};
}

}  // namespace armcal
