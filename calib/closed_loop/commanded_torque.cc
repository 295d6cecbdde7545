#include "calib/closed_loop/commanded_torque.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/closed_loop/commanded_reference.h"
#include "calib/logs/position_noise.h"
#include "model/dynamics/drive_filters.h"
#include "model/plant/motion_reader.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr long kPeriodsPerBlock = 1 << 14;

// The integral of a torque that is constant within each period, which begins
// with the first, by the times at periods' borders.
class Impulse {
 public:
  Impulse(double period, long periods, int n)
      : period_(period), sums_(MatrixXd::Zero(periods + 1, n)) {}

  void Add(const VectorXd& torque) {
    sums_.row(added_ + 1) = sums_.row(added_) + period_ * torque.transpose();
    ++added_;
  }
  Eigen::RowVectorXd Mean(double from, double to) const {
    return (At(to) - At(from)) / (to - from);
  }

 private:
  // Before and after its periods, as in the first and the last.
  Eigen::RowVectorXd At(double t) const {
    const double share = t / period_;
    const long k = std::clamp(static_cast<long>(std::floor(share)), 0L,
                              static_cast<long>(sums_.rows()) - 2);
    return sums_.row(k) +
           (share - static_cast<double>(k)) * (sums_.row(k + 1) - sums_.row(k));
  }

  double period_;
  MatrixXd sums_;
  long added_ = 0;
};

ReferenceMotion MeasuredMotion(const CommandedLog& commanded) {
  Log log;
  log.t = commanded.log.t;
  log.q = commanded.log.q;
  log.first_row = commanded.log.first_row;
  return MotionThrough(commanded.path, log);
}

// White normal noise, as many samples of each as there are standard deviations.
MatrixXd DrawWhite(const VectorXd& stddev, int samples, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(
      samples, stddev.size(),
      [&](Eigen::Index, Eigen::Index j) { return stddev[j] * normal(random); });
}

// What an integral holds follows from the positions of every period; logs have
// a part of these, and do not say what it held when they began.
bool Integrates(const DriveLaw& drive) {
  return drive.ki != 0 || drive.velocity_ki != 0;
}

}  // namespace

// Runs the drives over the log as they ran, at their own rate: positions
// between rows are those of the motion through the rows. A row's torque is a
// mean over the row's interval, from the torque's integral: at a point it would
// jump from period to period by the noise of one velocity.
MatrixXd CommandedTorque(const Robot& known,
                         const ControllerOptions& controller,
                         const CommandedLog& commanded, const VectorXd& times) {
  const int n = known.num_joints();
  const double duration = commanded.log.t[commanded.log.size() - 1];
  const double period = 1 / controller.rate_hz;
  const long periods = static_cast<long>(std::floor(duration / period)) + 1;
  const CommandedReference reference(known, controller.feedforward, commanded);
  const ReferenceMotion measured = MeasuredMotion(commanded);
  JointController drives(controller, known);
  DifferencedVelocity velocity(controller);
  std::vector<LaggedTorque> lags;
  for (const DriveLaw& drive : controller.drives) {
    lags.emplace_back(drive.lag, period);
  }
  Impulse impulse(period, periods, n);
  for (long first = 0; first < periods; first += kPeriodsPerBlock) {
    const long count = std::min(kPeriodsPerBlock, periods - first);
    const double begin = static_cast<double>(first) * period;
    const ReferenceSeries at =
        reference.At(begin, period, count, controller.delay);
    for (long k = 0; k < count; ++k) {
      const VectorXd q = measured.at(begin + static_cast<double>(k) * period).q;
      VectorXd torque =
          drives.Update({at.q.row(k), at.qd.row(k), at.qdd.row(k)},
                        at.feedforward.row(k), q, velocity.Update(q));
      for (int j = 0; j < n; ++j) torque[j] = lags[j].Mean(torque[j]);
      impulse.Add(torque);
    }
  }
  // Rows that are left out are rows of commands.
  const int rows = std::max(commanded.log.size(), commanded.command.size());
  const double half = duration / (2. * (rows - 1));
  MatrixXd torque(times.size(), n);
  for (Eigen::Index row = 0; row < times.size(); ++row) {
    torque.row(row) = impulse.Mean(times[row] - half, times[row] + half);
  }
  return torque;
}

// What position noise makes of the torque goes through the same drives, which
// amplify it by their gains; so a draw of it is passed through them. The
// derivative by the clock's rate is a difference over 1 %.
ReconstructedTorque ReconstructTorque(const Robot& known,
                                      const ControllerOptions& controller,
                                      const CommandedLog& commanded,
                                      const VectorXd& times, unsigned seed) {
  constexpr double kRate = .01;  // over which it is next to linear
  const Log& log = commanded.log;
  const auto torque = [&](const CommandedLog& of) {
    return CommandedTorque(known, controller, of, of.log.t);
  };
  const MatrixXd tau = torque(commanded);
  ReconstructedTorque result;
  result.tau = times.size() == tau.rows()
                   ? tau
                   : CommandedTorque(known, controller, commanded, times);
  result.t = log.t;
  result.position_noise = DrawWhite(PositionNoise(log.q - log.qref),
                                    static_cast<int>(log.t.size()), seed);
  CommandedLog other = commanded;
  other.log.q += result.position_noise;
  result.torque_noise = torque(other) - tau;
  other.log.q = log.q;
  other.log.t = log.t / (1 + kRate);
  other.command.t = commanded.command.t / (1 + kRate);
  result.by_rate = (tau - torque(other)) / kRate;
  result.drifts = std::any_of(controller.drives.begin(),
                              controller.drives.end(), &Integrates);
  return result;
}

}  // namespace armcal
