#include "calib/diagnose/judge/forward.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "calib/logs/position_noise.h"
#include "calib/numerics/undefined.h"
#include "model/log_files/time_base.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Deviations of a loop are averaged over this: a bootstrap of every sample
// would say the same, later.
constexpr double kBin = .02;  // s
// Of exact logs; differences of simulations are not smaller.
constexpr double kLeastFloor = 1e-9;  // rad or m

// Mean squares of all three robots, rows in time, rad^2 or m^2.
using Squares = std::array<MatrixXd, 3>;

// All three at once: an engine each. `simulate_after`: of the last.
template <typename Simulate, typename SimulateAfter>
Squares OfAll(const ForwardRobots& robots, const Simulate& simulate,
              const SimulateAfter& simulate_after) {
  Squares squares;
  tbb::parallel_invoke([&] { squares[0] = simulate(robots.nominal); },
                       [&] { squares[1] = simulate(robots.refit); },
                       [&] { squares[2] = simulate_after(robots.after); });
  return squares;
}

void Append(const MatrixXd& rows, MatrixXd* to) {
  const Eigen::Index before = to->rows();
  to->conservativeResize(before + rows.rows(), rows.cols());
  to->bottomRows(rows.rows()) = rows;
}

// Starts of the bins of a log whose times count, the first one after what a
// loop takes to settle (FirstCounted).
std::vector<int> Bins(const Log& log, int per_bin,
                      const std::function<bool(double)>& counts) {
  std::vector<int> bins;
  for (int k = FirstCounted(log); k + per_bin <= log.size(); k += per_bin) {
    if (counts(log.t[k])) bins.push_back(k);
  }
  return bins;
}

int RowsPerBin(const Log& log) {
  const double step = log.t[log.size() - 1] / (log.size() - 1);
  return std::max(1, static_cast<int>(std::lround(kBin / step)));
}

// The rows without NaN.
std::vector<int> Rows(const MatrixXd& squares) {
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < squares.rows(); ++k) {
    if (!squares.row(k).hasNaN()) rows.push_back(static_cast<int>(k));
  }
  return rows;
}

// Mean squares over the squared floor, so that they are in units of the
// floor's: the noise of the positions, or what that noise makes of a right
// robot. The figures take the floor for exactly known.
void SetFigures(const Squares& squares, const VectorXd& floor,
                std::uint64_t seed, ForwardGap* gap) {
  gap->has_figures = squares[0].rows() > 0;
  if (!gap->has_figures) return;
  gap->floor = floor.cwiseMax(kLeastFloor);
  const VectorXd weight = gap->floor.cwiseAbs2().cwiseInverse();
  gap->figures = RemovedShareFigures(
      {squares[0] * weight.asDiagonal(), squares[1] * weight.asDiagonal(),
       squares[2] * weight.asDiagonal()},
      0, seed);
  if (gap->figures.joints.size() > 0) {
    gap->figures.joints = gap->floor.asDiagonal() * gap->figures.joints;
  }
}

// A fit may be so absurd that its simulation is too stiff to take a step. That
// is no error of a user's input: the robot then counts as diverged, and the
// figures are of the others.
template <typename Simulate>
MatrixXd OrDiverged(const MatrixXd& diverged, const Simulate& simulate) try {
  return simulate();
} catch (const InputError&) {
  return diverged;
}

// Mean squares of a loop's position errors in bins, infinite where it diverges:
// a loop that runs away has no error that could be compared.
MatrixXd LoopSquares(const CorrectedRobot& robot, const Robot& known,
                     const ControllerOptions& controller,
                     const CommandedLog& log, const std::vector<int>& bins) {
  const auto count = static_cast<Eigen::Index>(bins.size());
  const MatrixXd infinite =
      MatrixXd::Constant(count, known.num_joints(), kInfinity);
  return OrDiverged(infinite, [&] {
    const ClosedLoopReplay replay =
        ReplayClosedLoop(robot.plant, robot.delay, known, controller, log);
    if (!replay.finite) return infinite;
    const int per_bin = RowsPerBin(log.log), first = FirstCounted(log.log);
    MatrixXd squares = infinite;
    for (Eigen::Index k = 0; k < count; ++k) {
      squares.row(k) = replay.position.middleRows(bins[k] - first, per_bin)
                           .colwise()
                           .squaredNorm() /
                       per_bin;
    }
    return squares;
  });
}

// Windows of which begin and end count.
ReplayWindows CountedWindows(const GapSegment& segment,
                             const CountedTimes& counted) {
  const ReplayWindows all = CutWindows(segment, kForwardWindow);
  if (!counted) return all;
  ReplayWindows windows{all.length, {}};
  for (const int k : all.begin) {
    if (counted(segment.log, segment.motion.time(k)) &&
        counted(segment.log, segment.motion.time(k + all.length))) {
      windows.begin.push_back(k);
    }
  }
  return windows;
}

}  // namespace

CountedTimes TimesWithRows(const GapRows& rows) {
  std::vector<std::pair<int, TimeRange>> parts;
  for (int j = 0; j < rows.num_joints(); ++j) {
    for (const GapRows::Run& run : rows.runs(j)) {
      const int k = run.begin - rows.thin_begin(run.segment);
      parts.push_back({rows.segments()[run.segment].log,
                       {rows.thin_time(run.segment, k),
                        rows.thin_time(run.segment, k + run.size - 1)}});
    }
  }
  return [parts](int log, double t) {
    return std::any_of(parts.begin(), parts.end(), [=](const auto& part) {
      return part.first == log && part.second.Contains(t);
    });
  };
}

// Each log is simulated in closed loop along its commands, once with each of
// three robots: as the file has it, refitted, and with the effects. Their
// errors are deviations of the simulated position from the recorded one. The
// floor is the noise of the positions themselves, which no model can remove,
// averaged over the logs.
ForwardGap ForwardGapInLoop(const ForwardRobots& robots, const Robot& known,
                            const ControllerOptions& controller,
                            const std::vector<CommandedLog>& logs,
                            std::uint64_t seed, const CountedTimes& counted) {
  ForwardGap gap;
  Squares squares;
  VectorXd floor = VectorXd::Zero(known.num_joints());  // squared
  for (const CommandedLog& log : logs) {
    const std::vector<int> bins =
        Bins(log.log, RowsPerBin(log.log),
             [&](double t) { return !counted || counted(gap.runs, t); });
    const auto squares_of = [&](const CorrectedRobot& robot) {
      return LoopSquares(robot, known, controller, log, bins);
    };
    const Squares found = OfAll(robots, squares_of, squares_of);
    for (int m = 0; m < 3; ++m) {
      gap.diverged[m] += !found[m].allFinite();
      Append(found[m], &squares[m]);
    }
    floor += PositionNoise(log.log.q).cwiseAbs2() / logs.size();
    ++gap.runs;
  }
  if (gap.runs > 0) SetFigures(squares, floor.cwiseSqrt(), seed, &gap);
  return gap;
}

// The same over short windows in open loop, where nothing is known of a
// controller. Every window starts from the recorded state, so that errors do
// not pile up, and is short enough to hold none of the instability of an open
// loop. The floor has to be simulated too: what noise of positions, velocities
// and torques alone does to the best of the three robots, over the same
// windows. Windows of which any robot is undefined (too stiff, or diverged)
// count in none, so that the three are compared on the same ones.
ForwardGap ForwardGapInWindows(const ForwardRobots& robots,
                               const std::vector<GapSegment>& segments,
                               const MeasurementNoise& noise,
                               std::uint64_t seed,
                               const CountedTimes& counted) {
  ForwardGap gap;
  gap.closed_loop = false;
  Squares squares;
  MatrixXd floor;
  for (const GapSegment& segment : segments) {
    const ReplayWindows windows = CountedWindows(segment, counted);
    if (windows.begin.empty()) continue;
    const auto count = static_cast<Eigen::Index>(windows.begin.size());
    const MatrixXd nothing =
        MatrixXd::Constant(count, segment.tau.cols(), kNaN);
    WindowSquares after = {nothing, nothing};
    const Squares found = OfAll(
        robots,
        [&](const CorrectedRobot& robot) {
          return OrDiverged(
              nothing, [&] { return ReplaySquares(robot, segment, windows); });
        },
        [&](const CorrectedRobot& robot) {
          return OrDiverged(nothing, [&] {
            after = ReplaySquaresWithNoise(robot, segment, windows, noise,
                                           seed + gap.runs);
            return after.error;
          });
        });
    Append(after.noise, &floor);
    for (int m = 0; m < 3; ++m) {
      gap.diverged[m] +=
          static_cast<int>(found[m].col(0).array().isNaN().count());
      Append(found[m], &squares[m]);
    }
    gap.runs += static_cast<int>(count);
  }
  if (gap.runs == 0) return gap;
  // NaN in any is NaN in the sum.
  const std::vector<int> rows = Rows(squares[0] + squares[1] + squares[2]);
  for (MatrixXd& one : squares) one = one(rows, Eigen::all).eval();
  floor = floor(Rows(floor), Eigen::all).eval();
  SetFigures(squares, floor.colwise().mean().cwiseSqrt(), seed, &gap);
  return gap;
}

}  // namespace armcal
