#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "calib/diagnose/select/fit.h"
#include "model/effects/effects.h"
#include "model/signals/low_pass.h"
#include "tests/fixtures/benchmark_log.h"

// The screen of a diagnosis: from 60 s of a six-joint arm's motion and torque
// in memory, at 250 Hz, to the effects that stand out (none does here): the
// baseline's columns and fit, the noise, every candidate's torque, and their
// delta chi^2. On all cores: in seconds of wall clock, or
// (DiagnosisScreenOf, of a part of the catalogue) of all cores' time. Counter
// `candidates`: columns of the screen, so that growth over their number can be
// told.

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr int kSeconds = 60, kStride = 4;  // of the log at 1 kHz
constexpr double kBandwidth = 10;          // Hz
constexpr double kNoise = .01;             // of the torque's rms

// The arm with friction and motors, which its file does not have.
Robot WithDrives(Robot robot, const Eigen::RowVectorXd& usual_torque) {
  for (int j = 0; j < robot.num_joints(); ++j) {
    Joint& joint = robot.links[j].joint;
    joint.coulomb = .1 * usual_torque[j];
    joint.viscous = .1 * usual_torque[j];
    joint.armature = .05 * usual_torque[j];
  }
  return robot;
}

struct RecordedArm {
  RecordedArm() {
    const Robot links = BenchmarkRobot();
    const Log log = BenchmarkLog(links, kSeconds * 1000 + 1);
    const auto thinned = [&](const MatrixXd& x) -> MatrixXd {
      return x(Eigen::seq(0, Eigen::last, kStride), Eigen::all);
    };
    GapSegment segment;
    segment.motion.dt = kStride * (log.t[1] - log.t[0]);
    segment.motion.q = thinned(log.q);
    segment.motion.qd = thinned(log.qd);
    segment.motion.qdd = thinned(log.qdd);
    const MatrixXd tau = thinned(log.tau);
    const Eigen::RowVectorXd rms =
        (tau.colwise().squaredNorm() / tau.rows()).cwiseSqrt();
    robot = WithDrives(links, rms);
    usual = rms;
    baseline = std::make_unique<GapBaseline>(robot, BaselineOptions(), usual);
    const RecordedTorque exact(robot, baseline->transitions(), segment.motion);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    segment.tau = exact.nominal();
    for (int j = 0; j < tau.cols(); ++j) {
      for (double& x : segment.tau.col(j))
        x += kNoise * rms[j] * normal(random);
    }
    segment.motion.torque = {
        ZeroPhaseLowPass(segment.tau, 1 / segment.motion.dt, 3), 3};
    segment.still.setConstant(segment.size(), tau.cols(), false);
    segments = {segment};
  }

  Robot robot;
  Eigen::VectorXd usual;  // torque, N m
  std::unique_ptr<GapBaseline> baseline;
  std::vector<GapSegment> segments;
};

// With the first `effects` of the catalogue.
void Screen(benchmark::State& state, int effects) {
  static const RecordedArm arm;
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  for (size_t i = effects; i < Effects().size(); ++i) {
    options.without.push_back(Effects()[i].name);
  }
  int columns = 0;
  for (auto _ : state) {
    GapFit fit(*arm.baseline, options, arm.segments, {});
    fit.Choose();
    columns = fit.screen().size();
  }
  using benchmark::Counter;
  state.counters["candidates"] = columns;
  state.counters["per_sample"] =
      Counter(1, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void DiagnosisScreen(benchmark::State& state) {
  Screen(state, static_cast<int>(Effects().size()));
}
BENCHMARK(DiagnosisScreen)->UseRealTime()->Unit(benchmark::kMillisecond);

void DiagnosisScreenOf(benchmark::State& state) {
  Screen(state, static_cast<int>(state.range(0)));
}
BENCHMARK(DiagnosisScreenOf)
    ->ArgName("effects")
    ->DenseRange(8, 32, 2)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace armcal
