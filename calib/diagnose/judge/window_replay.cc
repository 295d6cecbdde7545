#include "calib/diagnose/judge/window_replay.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "model/dynamics/motion_behind_readings.h"
#include "model/dynamics/motion_track.h"
#include "model/dynamics/rigid_arm.h"
#include "model/plant/arm_simulator.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLead = 1;  // s
// Bristles forget within a millimetre of motion, springs and dampers in a part
// of a second: what was that long ago makes no difference. Heat does.
constexpr double kLedFor = 10;  // s
constexpr double kStep = 1e-3;  // s, of the simulator, at most
constexpr double kLost = 100;   // rad or m
constexpr int kIterations = 4;  // of sensor maps, which are near the identity

// Signals with samples in columns.
struct Signals {
  MatrixXd q, qd, tau;
};

bool HasMemory(const CorrectedRobot& robot) {
  const std::vector<JointLaw>& laws = robot.plant.joint_laws;
  return !robot.effects.empty() ||
         std::any_of(laws.begin(), laws.end(), [](const JointLaw& law) {
           return law.initial_state.size() > 0;
         });
}

bool WarmsUp(const CorrectedRobot& robot) {
  return !robot.plant.thermal.empty();
}

// Windows one right after the other: [first, last) of all.
struct WindowRange {
  size_t first, last;
};
std::vector<WindowRange> ListRanges(const ReplayWindows& windows) {
  std::vector<WindowRange> ranges;
  for (size_t w = 0; w < windows.begin.size(); ++w) {
    if (w == 0 || windows.begin[w] > windows.begin[w - 1] + windows.length) {
      ranges.push_back({w, w});
    }
    ranges.back().last = w + 1;
  }
  return ranges;
}

// A robot along a segment.
class SegmentReplay {
 public:
  SegmentReplay(const CorrectedRobot& robot, const GapSegment& segment)
      : robot_(robot) {
    MotionTrack track;
    track.SetMotion(segment.motion);
    track.load = track.warmth = MatrixXd::Zero(track.num_joints(), size(track));
    Motion motion = segment.motion;
    VectorXd times = track.t;
    MotionBehindReadings(robot.plant, segment.motion, track, &motion, &times);
    MatrixXd tau = segment.tau;
    for (int k = 0; k < kIterations && !robot.plant.sensors.empty(); ++k) {
      tau += segment.tau - TorqueReadings(robot.plant.sensors, track, tau);
    }
    signals_ = {motion.q.transpose(), motion.qd.transpose(), tau.transpose()};
    begin_ = times[0];
    dt_ = (times[times.size() - 1] - begin_) / (times.size() - 1);
    steps_ = static_cast<int>(std::ceil(dt_ / kStep - 1e-9));
  }

  int num_joints() const { return static_cast<int>(signals_.q.rows()); }
  const Signals& signals() const { return signals_; }

  using Visit = std::function<void(int window, const ArmSimulator& start)>;
  // Simulators at the begin of each window, of several windows at a time.
  // Ranges of windows are led to from kLedFor before them, so that they can be
  // replayed side by side.
  void ForEachStart(const ReplayWindows& windows, const Visit& visit) const {
    std::vector<WindowRange> ranges = ListRanges(windows);
    if (WarmsUp(robot_)) ranges = {{0, windows.begin.size()}};
    tbb::parallel_for(size_t{0}, ranges.size(), [&](size_t r) {
      RigidArm engine(robot_.plant.robot);  // one per thread
      if (HasMemory(robot_)) {
        LeadTo(windows, ranges[r], visit, &engine);
        return;
      }
      for (size_t w = ranges[r].first; w < ranges[r].last; ++w) {
        visit(static_cast<int>(w), Start(windows.begin[w], &engine));
      }
    });
  }

  // Positions of the motors at `length` samples after row `begin`, n x length.
  MatrixXd Run(ArmSimulator simulator, int begin, int length,
               const MatrixXd& tau) const {
    MatrixXd q(num_joints(), length);
    for (int k = 0; k < length; ++k) {
      for (int i = 0; i < steps_; ++i) {
        simulator.Step(TorqueAt(tau, begin + k + (i + .5) / steps_));
      }
      q.col(k) = simulator.instant().position;
    }
    return q;
  }

 private:
  static int size(const MotionTrack& track) { return track.size(); }

  void LeadTo(const ReplayWindows& windows, const WindowRange& range,
              const Visit& visit, RigidArm* engine) const {
    int k = 0;
    if (!WarmsUp(robot_)) {
      k = std::max(0, windows.begin[range.first] -
                          static_cast<int>(std::ceil(kLedFor / dt_)));
    }
    ArmSimulator simulator = Start(k, engine);
    for (size_t w = range.first; w < range.last; ++k) {
      if (k == windows.begin[w]) visit(static_cast<int>(w++), simulator);
      Lead(k, &simulator);
    }
  }

  ArmSimulator Start(int row, RigidArm* engine) const {
    ArmSimulator simulator(robot_.plant, signals_.q.col(row),
                           {dt_ / steps_, 0, begin_ + row * dt_}, engine);
    simulator.SetMotors(signals_.q.col(row), signals_.qd.col(row));
    return simulator;
  }

  void Lead(int row, ArmSimulator* simulator) const {
    VectorXd q, qd;
    for (int i = 0; i < steps_; ++i) {
      simulator->Step(TorqueAt(signals_.tau, row + (i + .5) / steps_));
      const double share = (i + 1.) / steps_;
      InterpolateColumns(signals_.q, row, share, &q);
      InterpolateColumns(signals_.qd, row, share, &qd);
      simulator->SetMotors(q, qd);
    }
  }

  // Linear between samples, and later where recorded torque is.
  VectorXd TorqueAt(const MatrixXd& tau, double row) const {
    const double at = std::clamp(row + robot_.delay / dt_, 0., tau.cols() - 1.);
    const auto k =
        std::min<Eigen::Index>(static_cast<Eigen::Index>(at), tau.cols() - 2);
    return (1 - (at - k)) * tau.col(k) + (at - k) * tau.col(k + 1);
  }

  const CorrectedRobot& robot_;
  Signals signals_;
  double begin_, dt_;  // s
  int steps_;          // of the simulator per sample
};

// Columns of `error` as a row of mean squares.
Eigen::RowVectorXd MeanSquares(const MatrixXd& error) {
  if (!(error.cwiseAbs().maxCoeff() < kLost)) {
    return Eigen::RowVectorXd::Constant(
        error.rows(), std::numeric_limits<double>::quiet_NaN());
  }
  return error.rowwise().squaredNorm().transpose() / error.cols();
}

MatrixXd White(int samples, const VectorXd& stddev, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  MatrixXd x(samples, stddev.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = normal(*random);
  return x * stddev.asDiagonal();
}

// Autoregressive noise of the coarse grid on a finer one: drawn at its own
// step, and interpolated linearly in between, since it has no power beyond its
// grid. The first kSettled values settle the filter from zero.
VectorXd Coloured(const Autoregression& noise, double step, int samples,
                  double dt, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  constexpr int kSettled = 200;
  constexpr int p = Autoregression::kOrder;
  const int size = kSettled + static_cast<int>(samples * dt / step) + 3;
  VectorXd x = VectorXd::Zero(size);
  for (int t = p; t < size; ++t) {
    x[t] = noise.sigma * normal(*random) +
           noise.a.dot(x.segment<p>(t - p).reverse());
  }
  VectorXd fine(samples);
  for (int k = 0; k < samples; ++k) {
    const double at = k * dt / step;
    const int i = static_cast<int>(at);
    fine[k] = (1 - (at - i)) * x[kSettled + i] + (at - i) * x[kSettled + i + 1];
  }
  return fine;
}

Signals DrawNoise(const MeasurementNoise& noise, int samples, double dt,
                  std::mt19937_64* random) {
  // As loud per Hz on this grid as it is at its own rate.
  MatrixXd q =
      White(samples, noise.position / std::sqrt(dt * noise.rate_hz), random);
  if (noise.bandwidth_hz > 0) {
    q = ZeroPhaseLowPass(q, 1 / dt, noise.bandwidth_hz);
  }
  MatrixXd tau = MatrixXd::Zero(noise.position.size(), samples);
  for (size_t j = 0; j < noise.torque.size(); ++j) {
    tau.row(j) =
        Coloured(noise.torque[j], noise.torque_step, samples, dt, random);
  }
  return {q.transpose(), Differentiate(q, dt).transpose(), tau};
}

}  // namespace

ReplayWindows CutWindows(const GapSegment& segment, double window_s) {
  const double dt = segment.motion.dt;
  ReplayWindows windows{
      std::max(1, static_cast<int>(std::lround(window_s / dt))), {}};
  const int length = windows.length;
  const auto still = segment.still.rowwise().all();
  for (int k = static_cast<int>(std::ceil(kLead / dt));
       k + length < segment.size(); k += length) {
    if (2 * still.middleRows(k, length).count() <= length) {
      windows.begin.push_back(k);
    }
  }
  return windows;
}

MatrixXd ReplaySquares(const CorrectedRobot& robot, const GapSegment& segment,
                       const ReplayWindows& windows) {
  SegmentReplay replay(robot, segment);
  MatrixXd squares(windows.begin.size(), replay.num_joints());
  const int length = windows.length;
  replay.ForEachStart(windows, [&](int w, const ArmSimulator& start) {
    const int begin = windows.begin[w];
    squares.row(w) =
        MeanSquares(replay.Run(start, begin, length, replay.signals().tau) -
                    replay.signals().q.middleCols(begin + 1, length));
  });
  return squares;
}

// What noise alone makes of the windows: the same robot is simulated twice,
// from the recorded start and torque, and from these with one draw of noise,
// and their difference less the drawn position is what a right model would
// leave. The first of the two is the replay itself.
WindowSquares ReplaySquaresWithNoise(const CorrectedRobot& robot,
                                     const GapSegment& segment,
                                     const ReplayWindows& windows,
                                     const MeasurementNoise& noise,
                                     std::uint64_t seed) {
  SegmentReplay replay(robot, segment);
  std::mt19937_64 random(seed);
  const Signals added =
      DrawNoise(noise, segment.size(), segment.motion.dt, &random);
  const Signals& signals = replay.signals();
  const MatrixXd tau = signals.tau + added.tau;
  const auto count = static_cast<Eigen::Index>(windows.begin.size());
  WindowSquares squares = {MatrixXd(count, replay.num_joints()),
                           MatrixXd(count, replay.num_joints())};
  const int length = windows.length;
  replay.ForEachStart(windows, [&](int w, const ArmSimulator& start) {
    const int begin = windows.begin[w];
    ArmSimulator noisy = start;
    noisy.SetMotors(signals.q.col(begin) + added.q.col(begin),
                    signals.qd.col(begin) + added.qd.col(begin));
    const MatrixXd simulated = replay.Run(start, begin, length, signals.tau);
    squares.error.row(w) =
        MeanSquares(simulated - signals.q.middleCols(begin + 1, length));
    squares.noise.row(w) =
        MeanSquares(replay.Run(noisy, begin, length, tau) - simulated -
                    added.q.middleCols(begin + 1, length));
  });
  return squares;
}

}  // namespace armcal
