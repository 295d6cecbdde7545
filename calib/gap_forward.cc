#include "calib/gap_forward.h"

#include <array>
#include <cmath>
#include <future>
#include <limits>

#include "calib/position_noise.h"
#include "model/input_error.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Deviations of a loop are averaged over this: a bootstrap of every sample
// would say the same, later.
constexpr double kBin = .02;  // s
// Of exact logs; differences of simulations are not smaller.
constexpr double kLeastFloor = 1e-9;  // rad or m

// Mean squares of all three robots, rows in time, rad^2 or m^2.
using Squares = std::array<MatrixXd, 3>;

// All three at once: an engine each.
template <typename Simulate>
Squares OfAll(const ForwardRobots& robots, const Simulate& simulate) {
  auto nominal =
      std::async(std::launch::async, [&] { return simulate(robots.nominal); });
  auto refit =
      std::async(std::launch::async, [&] { return simulate(robots.refit); });
  const MatrixXd after = simulate(robots.after);
  return {nominal.get(), refit.get(), after};
}

void Append(const MatrixXd& rows, MatrixXd* to) {
  const Eigen::Index before = to->rows();
  to->conservativeResize(before + rows.rows(), rows.cols());
  to->bottomRows(rows.rows()) = rows;
}

// Mean squares over bins.
MatrixXd Binned(const MatrixXd& deviation, int per_bin) {
  const Eigen::Index bins = deviation.rows() / per_bin;
  MatrixXd squares(bins, deviation.cols());
  for (Eigen::Index k = 0; k < bins; ++k) {
    squares.row(k) =
        deviation.middleRows(k * per_bin, per_bin).colwise().squaredNorm() /
        per_bin;
  }
  return squares;
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

void SetFigures(const Squares& squares, const VectorXd& floor,
                std::uint64_t seed, ForwardGap* gap) {
  gap->floor = floor.cwiseMax(kLeastFloor);
  const VectorXd weight = gap->floor.cwiseAbs2().cwiseInverse();
  gap->figures = ShrinkFigures(
      {squares[0] * weight.asDiagonal(), squares[1] * weight.asDiagonal(),
       squares[2] * weight.asDiagonal()},
      seed);
  if (gap->figures.joints.size() > 0) {
    gap->figures.joints = gap->floor.asDiagonal() * gap->figures.joints;
  }
}

// A robot that is too stiff to simulate, as an absurd fit may be, diverges.
template <typename Simulate>
MatrixXd OrDiverged(Eigen::Index rows, Eigen::Index columns, double what,
                    const Simulate& simulate) try {
  return simulate();
} catch (const InputError&) {
  return MatrixXd::Constant(rows, columns, what);
}

// Binned squares of a loop, infinite where it diverges.
MatrixXd LoopSquares(const CorrectedRobot& robot, const Robot& known,
                     const ControllerOptions& controller,
                     const CommandedLog& log) {
  const int per_bin = RowsPerBin(log.log);
  const Eigen::Index bins = (log.log.size() - FirstCounted(log.log)) / per_bin;
  const Eigen::Index n = known.num_joints();
  return OrDiverged(bins, n, kInfinity, [&]() -> MatrixXd {
    const ClosedLoopReplay replay =
        ReplayClosedLoop(robot.plant, robot.delay, known, controller, log);
    return replay.finite ? Binned(replay.position, per_bin)
                         : MatrixXd::Constant(bins, n, kInfinity);
  });
}

}  // namespace

ForwardGap ForwardGapInLoop(const ForwardRobots& robots, const Robot& known,
                            const ControllerOptions& controller,
                            const std::vector<CommandedLog>& logs,
                            std::uint64_t seed) {
  ForwardGap gap;
  Squares squares;
  VectorXd floor = VectorXd::Zero(known.num_joints());  // squared
  for (const CommandedLog& log : logs) {
    const Squares found = OfAll(robots, [&](const CorrectedRobot& robot) {
      return LoopSquares(robot, known, controller, log);
    });
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

ForwardGap ForwardGapInWindows(const ForwardRobots& robots,
                               const std::vector<GapSegment>& segments,
                               const MeasurementNoise& noise,
                               std::uint64_t seed) {
  ForwardGap gap;
  gap.closed_loop = false;
  Squares squares;
  MatrixXd floor;
  for (const GapSegment& segment : segments) {
    const ReplayWindows windows = CutWindows(segment, kForwardWindow);
    if (windows.begin.empty()) continue;
    const auto count = static_cast<Eigen::Index>(windows.begin.size());
    const Eigen::Index n = segment.tau.cols();
    auto alone = std::async(std::launch::async, [&] {
      return OrDiverged(count, n, kNaN, [&] {
        return NoiseSquares(robots.after, segment, windows, noise,
                            seed + gap.runs);
      });
    });
    const Squares found = OfAll(robots, [&](const CorrectedRobot& robot) {
      return OrDiverged(count, n, kNaN,
                        [&] { return ReplaySquares(robot, segment, windows); });
    });
    Append(alone.get(), &floor);
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
