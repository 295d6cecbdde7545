#include "model/plant/closed_loop.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {

namespace {

// Control periods per row of the log; 0: not a whole number.
int PeriodsPerSample(const ClosedLoopOptions& options) {
  const double ratio = options.controller.rate_hz / options.sensors.log_rate_hz;
  const double periods = std::round(ratio);
  const bool whole = std::abs(ratio - periods) <= 1e-9 * periods;
  return periods >= 1 && whole ? static_cast<int>(periods) : 0;
}

// Rows of equal width that grow.
class Table {
 public:
  void Add(const Eigen::VectorXd& row) {
    values_.insert(values_.end(), row.data(), row.data() + row.size());
    width_ = row.size();
  }
  Eigen::MatrixXd Matrix() const {
    using RowMajor =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (width_ == 0) return {};
    return Eigen::Map<const RowMajor>(values_.data(), values_.size() / width_,
                                      width_);
  }

 private:
  std::vector<double> values_;
  long width_ = 0;
};

class Recorder {
 public:
  Recorder(const SimulatedRobot& robot, const ClosedLoopOptions& options,
           int num_driven)
      : clock_(robot.clock),
        sampling_(options.sensors, PeriodsPerSample(options),
                  options.controller.rate_hz),
        noise_(options.sensors, num_driven) {}

  bool Wants(long tick) { return sampling_.Samples(tick); }

  void Add(double t, const Reading& reading, const Eigen::VectorXd& qref) {
    const double dt = times_.empty() ? 0 : t - last_;
    last_ = t;
    times_.push_back(clock_ ? clock_(t) : t);
    q_.Add(reading.position);
    qd_.Add(reading.velocity);
    tau_.Add(reading.torque + noise_.Next(dt));
    qref_.Add(qref);
    temperature_.Add(reading.temperature);
  }

  Log Finish() const {
    Log log;
    log.t = Eigen::Map<const Eigen::VectorXd>(times_.data(), times_.size());
    log.q = q_.Matrix();
    log.qd = qd_.Matrix();
    log.tau = tau_.Matrix();
    log.qref = qref_.Matrix();
    log.temperature = temperature_.Matrix();
    return log;
  }

 private:
  std::function<double(double)> clock_;
  SamplingClock sampling_;
  TorqueNoise noise_;
  double last_ = 0;
  std::vector<double> times_;
  Table q_, qd_, tau_, qref_, temperature_;
};

// The torques of the last control periods, for a log whose torque is old.
class TorqueHistory {
 public:
  TorqueHistory(int n, double delay_periods)
      : delay_(delay_periods),
        past_(static_cast<int>(std::ceil(delay_periods)) + 2,
              Eigen::VectorXd::Zero(n)) {}

  void Push(const Eigen::VectorXd& torque) {
    past_.pop_back();
    past_.insert(past_.begin(), torque);
  }
  // As it was the delay before the last instant at which the torque changed;
  // the mean of before and after where the delay is a whole number of periods.
  Eigen::VectorXd Delayed() const {
    const int whole = static_cast<int>(std::lround(delay_));
    const double share = delay_ + .5 - whole;
    return (1 - share) * past_[whole] + share * past_[whole + 1];
  }

 private:
  double delay_;
  std::vector<Eigen::VectorXd> past_;
};

// A lag that makes no difference: it would only cost substeps.
constexpr double kShortestLag = 1e-4;  // s

// Puts a first-order lag of each driven joint before what else its motor does.
void InsertLag(const Eigen::VectorXd& time_constant, SimulatedRobot* robot) {
  if (time_constant.maxCoeff() < kShortestLag) return;
  ActuatorMap lag;
  lag.initial_state = Eigen::VectorXd::Zero(time_constant.size());
  lag.apply = [time_constant](const ArmInstant&, const double* state,
                              double* rate, Eigen::VectorXd* torque) {
    for (int j = 0; j < time_constant.size(); ++j) {
      rate[j] = 0;
      if (time_constant[j] < kShortestLag) continue;
      rate[j] = ((*torque)[j] - state[j]) / time_constant[j];
      (*torque)[j] = state[j];
    }
  };
  robot->actuators.insert(robot->actuators.begin(), lag);
}

// The lags of the drives. And torque that is recorded before the motors give it
// is commanded, and they lag.
SimulatedRobot WithLags(SimulatedRobot robot,
                        const ControllerOptions& controller) {
  const int n = robot.robot.num_joints() - robot.num_passive;
  Eigen::VectorXd lag(n);
  for (int j = 0; j < n; ++j) lag[j] = controller.drives[j].lag;
  if (robot.torque_delay < 0) {
    InsertLag(Eigen::VectorXd::Constant(n, -robot.torque_delay), &robot);
    robot.torque_delay = 0;
  }
  InsertLag(lag, &robot);
  return robot;
}

class Loop {
 public:
  Loop(const SimulatedRobot& robot, const Robot& model,
       const ReferenceMotion& motion, const ClosedLoopOptions& options,
       ArmDynamics* dynamics)
      : robot_(robot),
        motion_(motion),
        options_(options),
        n_(model.num_joints()),
        period_(1 / options.controller.rate_hz),
        steps_(static_cast<int>(std::ceil(period_ / options.step - 1e-9))),
        settle_(std::lround(options.settle / period_)),
        // Laws see the time of the log.
        simulator_(robot, Start(), {period_ / steps_, 0, -settle_ * period_},
                   dynamics),
        velocity_(options.controller),
        controller_(options.controller, model),
        encoders_(options.sensors, n_),
        recorder_(robot, options, n_),
        history_(
            n_, (options.sensors.torque_delay + robot.torque_delay) / period_) {
    CHECK_EQ(robot.robot.num_joints(), n_ + robot.num_passive);
  }

  ClosedLoopRun Run() {
    const long end = std::lround(motion_.duration / period_);
    ClosedLoopRun run;
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(n_);
    long saturated = 0, periods = 0;
    for (long tick = -settle_; tick <= end; ++tick) {
      const bool at_limit = Tick(tick, tick >= 0 && recorder_.Wants(tick));
      run.finite = simulator_.finite();
      if (!run.finite) break;
      if (tick < 0) continue;
      ++periods;
      squares += error_.cwiseAbs2();
      run.tracking_peak =
          std::max(run.tracking_peak, error_.cwiseAbs().maxCoeff());
      saturated += at_limit;
      if (options_.progress && tick % 1000 == 0) {
        options_.progress(tick / static_cast<double>(end + 1));
      }
    }
    run.tracking_rms = (squares / periods).cwiseSqrt();
    run.saturated_share =
        saturated / std::max(1.0, static_cast<double>(periods));
    run.log = recorder_.Finish();
    run.link_position = links_.Matrix();
    return run;
  }

 private:
  Eigen::VectorXd Start() const {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(robot_.robot.num_joints());
    q.tail(n_) = motion_.at(0).q;
    return q;
  }

  // What sensors make of a velocity that the controller has from positions and
  // of the motors' recorded torque.
  Reading Read(const Eigen::VectorXd& velocity,
               const Eigen::VectorXd& torque) const {
    const ArmInstant& instant = simulator_.instant();
    Reading reading{instant.position.tail(n_), velocity, torque,
                    instant.temperature.tail(n_).array() + robot_.ambient};
    for (const SensorMap& map : robot_.sensors) map.apply(instant, &reading);
    return reading;
  }

  // One control period; whether a torque is at its limit.
  bool Tick(long tick, bool record) {
    const double t = std::max(0L, tick) * period_;
    const ReferencePoint reference = motion_.at(t);
    const double delay = options_.controller.delay;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n_);
    const Eigen::VectorXd position =
        encoders_.Measure(Read(zero, zero).position);
    const Eigen::VectorXd& differenced = velocity_.Update(position);
    const Eigen::VectorXd torque = controller_.Update(
        delay > 0 ? motion_.at(std::max(0.0, t - delay)) : reference, position,
        Read(differenced, zero).velocity);
    history_.Push(torque);
    error_ = reference.q - position;
    if (record) {
      Reading reading = Read(differenced, history_.Delayed());
      reading.position = position;
      recorder_.Add(t, reading, reference.q);
      if (!robot_.transmissions.empty()) {
        links_.Add(simulator_.instant().link_position.tail(n_));
      }
    }
    for (int k = 0; k < steps_; ++k) simulator_.Step(torque);
    return controller_.at_limit();
  }

  const SimulatedRobot& robot_;
  const ReferenceMotion& motion_;
  const ClosedLoopOptions& options_;
  int n_;
  double period_;
  int steps_;    // of the simulator per control period
  long settle_;  // control periods before the log
  ArmSimulator simulator_;
  DifferencedVelocity velocity_;
  JointController controller_;
  Encoders encoders_;
  Recorder recorder_;
  Table links_;
  TorqueHistory history_;
  Eigen::VectorXd error_;
};

}  // namespace

bool LogRateFits(const ClosedLoopOptions& options) {
  return PeriodsPerSample(options) > 0;
}

ClosedLoopRun RunClosedLoop(const SimulatedRobot& robot, const Robot& model,
                            const ReferenceMotion& motion,
                            const ClosedLoopOptions& options,
                            ArmDynamics* dynamics) {
  if (!LogRateFits(options)) {
    throw InputError("simulation", "log rate",
                     NumberText(options.sensors.log_rate_hz),
                     "expected Hz that divide the controller's rate of " +
                         NumberText(options.controller.rate_hz));
  }
  return Loop(WithLags(robot, options.controller), model, motion, options,
              dynamics)
      .Run();
}

}  // namespace armcal
