#include "tools/python/command_binding.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <chrono>
#include <thread>

#include "calib/logs/torque_trace.h"
#include "calib/numerics/thread_limit.h"
#include "model/log_files/log_reader.h"
#include "model/signals/trajectory.h"
#include "model/text/decimal_point.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/python/command_flags.h"
#include "tools/python/loaded_robot.h"
#include "tools/python/log_arrays.h"
#include "tools/python/samples.h"

namespace armcal {
namespace {

namespace py = pybind11;

// Passes progress on to Python, and signals such as Ctrl-C, some times a
// second; from the thread of the command only, which an exception ends.
class Reporter {
 public:
  explicit Reporter(py::object callback) : callback_(std::move(callback)) {}
  ~Reporter() {
    const py::gil_scoped_acquire acquire;
    callback_ = py::none();
  }
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  Progress AsProgress() {
    return [this](const std::string& stage, double fraction) {
      Report(stage, fraction);
    };
  }

 private:
  void Report(const std::string& stage, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    const bool news = stage != stage_ || fraction >= 1;
    if (std::this_thread::get_id() != thread_) return;
    if (!news && now - last_ < std::chrono::milliseconds(50)) return;
    last_ = now;
    stage_ = stage;
    CheckSignals();
    if (callback_.is_none()) return;
    const py::gil_scoped_acquire acquire;
    callback_(stage, fraction);
  }

  py::object callback_;
  std::thread::id thread_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point last_;
  std::string stage_;
};

// What Python sees of a CommandOutcome.
struct Outcome {
  int code = 0;
  std::string text, brief;
  std::vector<std::pair<std::string, std::string>> files;
  std::optional<LoadedRobot> robot;
  std::shared_ptr<const TracedModel> model;
};

// Holds no GIL. Several may run at once, each with the threads it asks for.
CommandOutcome RunWithInput(const Command& command, const CommandInput& input,
                            bool write) {
  CommandOutcome outcome;
  WithThreads(ThreadsFromFlags(input.flags),
              [&] { outcome = command.run(input); });
  if (write) OutputFolder::WriteTogether(&outcome.folders);
  return outcome;
}

Outcome Run(const std::string& name, const FlagTexts& flags,
            const std::optional<LoadedRobot>& robot, const py::object& progress,
            const PythonLogs& logs, bool write) {
  Reporter reporter(progress);
  CommandInput input;
  input.logs = LogSources(logs);
  const py::gil_scoped_release release;
  const Command& command = CommandNamed(name);
  input.flags = FlagsOf(command, flags);
  if (robot) {
    input.robot = robot->robot;
    input.robot_file = robot->file;
  }
  input.progress = reporter.AsProgress();
  input.report = true;
  const CommandOutcome found = RunWithInput(command, input, write);
  Outcome outcome{found.code(), TextWithNotes(found.output),
                  found.brief,  {},
                  {},           found.model};
  for (const OutputFolder& folder : found.folders) {
    for (const auto& file : folder.files()) outcome.files.push_back(file);
  }
  if (found.robot) {
    outcome.robot = robot.value_or(LoadedRobot{{}, "", "", "", {}, ""});
    outcome.robot->robot = *found.robot;
  }
  return outcome;
}

py::dict FilesOf(const Outcome& outcome) {
  py::dict files;
  for (const auto& [name, content] : outcome.files) {
    files[py::str(name)] = py::bytes(content);
  }
  return files;
}

// A log with `model`'s prediction.
struct PredictedLog {
  std::string path;
  Eigen::VectorXd t;
  Eigen::MatrixXd measured, predicted;
};

PredictedLog FromTrace(const TorqueTrace& trace, const std::string& path,
                       int n) {
  const auto& bins = trace.torque.bins();  // a sample each
  const auto size = static_cast<Eigen::Index>(bins.size());
  PredictedLog log{path, Eigen::VectorXd(size), Eigen::MatrixXd(size, n),
                   Eigen::MatrixXd(size, n)};
  for (Eigen::Index k = 0; k < size; ++k) {
    log.t[k] = bins[k].begin;
    log.measured.row(k) = bins[k].low.head(n).transpose();
    log.predicted.row(k) = bins[k].low.segment(n, n).transpose();
  }
  return log;
}

// Torques low-passed at four times the bandwidth, as report.html draws them.
std::vector<PredictedLog> Trace(const Outcome& outcome,
                                const LoadedRobot& robot,
                                const FlagTexts& flags, double bandwidth_hz,
                                const PythonLogs& in_memory,
                                const py::object& progress) {
  constexpr int kMostSamples = 1 << 22;
  if (outcome.model == nullptr) {
    throw py::value_error("nothing was calibrated that predicts torques");
  }
  Reporter reporter(progress);
  CommandInput input;
  input.logs = LogSources(in_memory);
  const py::gil_scoped_release release;
  input.flags = FlagsOf(CommandNamed("calibrate"), flags);
  const LogSet logs(SourcesOf(input, LogsFromFlags(input)),
                    LogOptionsFromFlags(input.flags, robot.robot),
                    CropFromFlags(input.flags));
  PreparationOptions prepared;
  prepared.bandwidth_hz = bandwidth_hz;
  std::vector<PredictedLog> predicted;
  for (const TorqueTrace& trace :
       TraceTorques({*outcome.model}, kMostSamples, reporter.AsProgress(),
                    Prepare(logs, prepared))) {
    predicted.push_back(
        FromTrace(trace, logs.path(trace.log), robot.robot.num_joints()));
  }
  return predicted;
}

Log ReadLog(const std::string& path, const LoadedRobot& robot,
            const FlagTexts& flags, bool torque, bool wrench) {
  LogReaderOptions options =
      LogOptionsFromFlags(FlagsOf(CommandNamed("inspect"), flags), robot.robot);
  options.need_torque = torque;
  options.want_velocity = options.want_acceleration = true;
  options.want_reference = options.want_temperature = true;
  options.want_wrench = wrench;
  return ReadWholeLog(path, options);
}

}  // namespace

void AddCommands(py::module_* module) {
  py::class_<Outcome>(*module, "Outcome", "What a command has to say.")
      .def_readonly("code", &Outcome::code, "The command's exit code, 0 or 1.")
      .def_readonly("text", &Outcome::text, "What it prints.")
      .def_readonly("brief", &Outcome::brief, "A sentence of it, or nothing.")
      .def_property_readonly("files", &FilesOf, "Its result files.")
      .def_readonly("robot", &Outcome::robot, "Calibrated or corrected.");
  py::class_<PredictedLog>(*module, "PredictedLog",
                           "A log's torques and those of a calibrated model.")
      .def_readonly("path", &PredictedLog::path, "The log.")
      .def_readonly("t", &PredictedLog::t, "(N,), s since its first row.")
      .def_readonly("measured", &PredictedLog::measured, "(N, n), N m or N.")
      .def_readonly("predicted", &PredictedLog::predicted, "(N, n), N m or N.");
  py::class_<Log>(*module, "LogArrays", "Signals of a log, empty if not in it.")
      .def_readonly("t", &Log::t)
      .def_readonly("q", &Log::q)
      .def_readonly("qd", &Log::qd)
      .def_readonly("qdd", &Log::qdd)
      .def_readonly("tau", &Log::tau)
      .def_readonly("qref", &Log::qref)
      .def_readonly("temperature", &Log::temperature)
      .def_readonly("wrench", &Log::wrench)
      .def_readonly("simulated", &Log::simulated);
  module->def("run", &Run, py::arg("command"), py::arg("flags"),
              py::arg("robot") = py::none(), py::arg("progress") = py::none(),
              py::arg("logs") = PythonLogs(), py::arg("write") = false,
              py::call_guard<DecimalPoint>(),
              "Runs a command of the armcal binary on files and on logs "
              "{name: {array's name: array}} that flags name; with write its "
              "files go to the folders that the flags name.");
  module->def("trace", &Trace, py::arg("outcome"), py::arg("robot"),
              py::arg("flags"), py::arg("bandwidth_hz"),
              py::arg("logs") = PythonLogs(), py::arg("progress") = py::none(),
              py::call_guard<DecimalPoint>(),
              "Measured and predicted torques of logs.");
  module->def("read_log", &ReadLog, py::arg("path"), py::arg("robot"),
              py::arg("flags"), py::arg("torque") = true,
              py::arg("wrench") = false,
              py::call_guard<DecimalPoint, py::gil_scoped_release>(),
              "The signals of a log that the robot has joints for.");
}

}  // namespace armcal
