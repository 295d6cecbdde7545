#include "tests/blind/real_log.h"

#include <algorithm>
#include <filesystem>

#include "model/log_files/log_reader.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Motor constants of the UR10e as the logs' authors give them (SOURCE.md).
const std::vector<double> kUr10eConstants = {14.87, 13.26, 11.13,
                                             10.62, 11.03, 11.47};

RealLog LogOf(const std::string& arm, const std::string& log,
              const std::string& reference) {
  RealLog real;
  real.arm = arm;
  real.robot = "robot.urdf";
  real.log = log;
  real.reference = reference;
  return real;
}

RealLog Ur10e(const std::string& log) {
  RealLog real = LogOf("ur10e_free", log + ".csv", "id_50s.csv");
  real.torque_constants = kUr10eConstants;
  return real;
}

// The rest of a log, whose reference is what came before.
RealLog LaterPart(RealLog real, double begin) {
  real.reference = real.log;
  real.reference_span.end = begin;
  real.span.begin = begin;
  return real;
}

// Robots that the diagnosis may be improved on.
std::vector<RealLog> CalibrationLogs() {
  std::vector<RealLog> logs;
  for (const char* log : {"id_20s", "id_30s", "id_40s", "val_ptp"}) {
    logs.push_back(Ur10e(log));
  }
  logs.push_back(LaterPart(Ur10e("id_50s"), 28));
  logs.push_back(LaterPart(LogOf("panda", "log.csv", ""), 10));
  logs.push_back(LogOf("kr300", "log_B.csv.gz", "log_A.csv.gz"));
  logs.push_back(LogOf("kr300", "log_C.csv.gz", "log_B.csv.gz"));
  logs.push_back(LogOf("schunk_lwa4p", "run_092.csv.gz", "run_091.csv.gz"));
  logs.push_back(LogOf("schunk_lwa4p", "run_017.csv.gz", "run_016.csv.gz"));
  return logs;
}

// Robots that it is judged by.
std::vector<RealLog> EvaluationLogs() {
  std::vector<RealLog> logs;
  logs.push_back(LaterPart(LogOf("tx40", "log.csv.gz", ""), 4.5));
  logs.push_back(LogOf("dvrk_psm", "reference_val.csv.gz", "reference.csv.gz"));
  logs.back().flags = {"--gravity=0,0,-9.81"};
  for (const char* pair : {"1", "4"}) {
    const std::string later(1, static_cast<char>(pair[0] + 1));
    RealLog real = LogOf("dfki_double_pendulum", "A0_sysid_0" + later + ".csv",
                         std::string("A0_sysid_0") + pair + ".csv");
    real.robot = "robot_A.urdf";
    logs.push_back(real);
  }
  logs.push_back(
      LogOf("dfki_acrobot", "reference_06.csv.gz", "reference_01.csv.gz"));
  logs.push_back(LogOf("dfki_simple_pendulum", "swing_B.csv", "swing_A.csv"));
  return logs;
}

MatrixXd Rows(const MatrixXd& x, const std::vector<int>& rows) {
  if (x.size() == 0) return {};
  return x(rows, Eigen::all);
}

}  // namespace

std::string RealLog::name() const {
  return arm + "/" + log.substr(0, log.find('.'));
}

const std::vector<RealLog>& RealLogs(BlindSet set) {
  static const std::vector<RealLog> kCalibration = CalibrationLogs();
  static const std::vector<RealLog> kEvaluation = EvaluationLogs();
  return set == BlindSet::kEvaluation ? kEvaluation : kCalibration;
}

Log ReadRealLog(const std::string& path, const TimeRange& span,
                const std::vector<std::string>& joint_names,
                const std::vector<double>& torque_constants) {
  LogReaderOptions options;
  options.joint_names = joint_names;
  options.torque_constants = torque_constants;
  options.want_velocity = true;
  const Log all = ReadWholeLog(path, options);
  std::vector<int> rows;
  for (int k = 0; k < all.size(); ++k) {
    if (span.Contains(all.t[k])) rows.push_back(k);
  }
  Log log;
  log.t = all.t(rows);
  log.t.array() -= log.t[0];
  log.q = Rows(all.q, rows);
  log.qd = Rows(all.qd, rows);
  log.tau = Rows(all.tau, rows);
  return log;
}

MatrixXd Interpolate(const VectorXd& t, const MatrixXd& x, const VectorXd& at) {
  MatrixXd y(at.size(), x.cols());
  int k = 0;
  for (int i = 0; i < at.size(); ++i) {
    while (k + 2 < t.size() && t[k + 1] < at[i]) ++k;
    const double step = t[k + 1] - t[k];
    const double u = step > 0 ? std::clamp((at[i] - t[k]) / step, 0., 1.) : 0.;
    y.row(i) = (1 - u) * x.row(k) + u * x.row(k + 1);
  }
  return y;
}

Log UniformLog(const Log& log) {
  const double duration = log.t[log.size() - 1] - log.t[0];
  const double rate = (log.size() - 1) / duration;
  const int size = static_cast<int>(duration * kUniformRateHz) + 1;
  Log uniform;
  uniform.t = VectorXd::LinSpaced(size, log.t[0],
                                  log.t[0] + (size - 1) / kUniformRateHz);
  const auto sampled = [&](const MatrixXd& x) {
    return Interpolate(log.t, ZeroPhaseLowPass(x, rate, .4 * kUniformRateHz),
                       uniform.t);
  };
  uniform.q = sampled(log.q);
  uniform.tau = sampled(log.tau);
  return uniform;
}

PlantMotion RealMotion(const Log& uniform) {
  constexpr double kBandwidthHz = 10;
  const VectorXd dt = Differentiate(uniform.t, 1);
  const auto rate = [&dt](const MatrixXd& x) {
    return MatrixXd(Differentiate(x, 1).array().colwise() / dt.array());
  };
  PlantMotion motion;
  motion.rate = kUniformRateHz;
  motion.q = ZeroPhaseLowPass(uniform.q, motion.rate, kBandwidthHz,
                              Ends::kExtrapolate);
  motion.qd = rate(motion.q);
  motion.qdd = rate(motion.qd);
  return motion;
}

}  // namespace armcal
