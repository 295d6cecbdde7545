#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/batch_rollout.h"
#include "model/simd/kernels.h"
#include "tests/fixtures/fma_peak.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

// Kernels must not become slower unnoticed. Their time is compared with that of
// as many multiply-adds in registers, in one process and in turns: a ratio that
// the clock's rate and other programs leave alone, since the least of many runs
// of some 50 us counts.

namespace armcal::kernel_speed_test {

constexpr long kRows = 256, kStride = kRows + 8;
// A quarter above what was measured when they were set, on an EPYC of Zen 4,
// where a busy machine moves the ratios by 2 %. Other processors, whose caches
// are slower or faster beside their arithmetic, are not judged by them;
// tools/bench.sh says what they reach.
struct Limits {
  double regressor, factor, step;
};
const std::map<std::string, Limits> kLimits = {{"baseline", {3.8, 1.7, 2.75}},
                                               {"avx2", {4.8, 2.1, 3.6}},
                                               {"avx512", {3.5, 1.9, 2.4}}};
// Of 0.1 to 0.2 ms; ends when it is fast. A neighbour on the same core may make
// half a second of them slow.
constexpr int kAttempts = 20000;

double Seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> took =
      std::chrono::steady_clock::now() - start;
  return took.count();
}

// Least time of `work`, over that of `flops` at the core's peak. `prepare` is
// not timed.
double TimesTheFlopLimit(const std::string& set, double flops, double limit,
                         const std::function<void()>& prepare,
                         const std::function<void()>& work) {
  const MultiplyAdds multiply_adds = MultiplyAddsOf(set);
  double peak = 0, least = 1e9;
  for (int k = 0; k < kAttempts; ++k) {
    peak = std::max(peak, multiply_adds.flops /
                              Seconds([&] { (void)multiply_adds.run(); }));
    prepare();
    least = std::min(least, Seconds(work));
    if (k > 20 && least * peak / flops <= limit) break;
  }
  return least * peak / flops;
}

class KernelSpeed : public testing::TestWithParam<const simd::Kernels*> {
 protected:
  void SetUp() override {
#if !defined(NDEBUG) || defined(SANITIZED)
    GTEST_SKIP() << "only an optimized build without sanitizers has a speed";
#endif
    if (!IsZen4()) GTEST_SKIP() << "the limits are those of a Zen 4";
  }
  static bool IsZen4() {
#ifdef __x86_64__
    return __builtin_cpu_is("amdfam19h") && __builtin_cpu_supports("avx512f");
#else
    return false;
#endif
  }
  std::string set() const { return GetParam()->instruction_set; }
};

// 2049 flops per sample of a 6R arm with links of ten parameters each.
TEST_P(KernelSpeed, Regressor) {
  std::mt19937_64 random(1);
  Robot robot = SampleRobot("UR5 6R");
  const Log log = RecordMotion(RandomMultisine(&random, 6), kRows, 1);
  const BatchRegressor regressor(robot, *GetParam());
  const MotionColumns motion(log.q, log.qd, log.qdd, {});
  std::vector<std::vector<double>> rows;
  std::vector<double*> out;
  for (int i = 0; i < 6; ++i) {
    rows.emplace_back(regressor.row_size(i) * kStride);
    out.push_back(rows.back().data());
  }
  const double limit = kLimits.at(set()).regressor;
  const double times = TimesTheFlopLimit(
      set(), 2049. * kRows, limit, [] {},
      [&] { regressor.Differential(motion, kRows, out.data(), kStride); });
  std::printf("%s: %.2f times the flop limit\n", set().c_str(), times);
  EXPECT_LE(times, limit);
}

// 2 k^2 flops per row of k columns.
TEST_P(KernelSpeed, TriangularFactor) {
  constexpr int kColumns = 61;
  std::mt19937_64 random(1);
  std::vector<double> R(kColumns * kColumns), X(kColumns * kStride);
  for (double& x : R) x = Uniform(&random, -1, 1);
  for (double& x : X) x = Uniform(&random, -1, 1);
  std::vector<double> R_copy, X_copy;
  const double limit = kLimits.at(set()).factor;
  const double times = TimesTheFlopLimit(
      set(), 2. * kColumns * kColumns * kRows, limit,
      [&] { R_copy = R, X_copy = X; },
      [&] {
        GetParam()->householder(R_copy.data(), kColumns, kColumns,
                                X_copy.data(), kStride, kRows, false);
      });
  std::printf("%s: %.2f times the flop limit\n", set().c_str(), times);
  EXPECT_LE(times, limit);
}

// Four evaluations of a mass matrix (Featherstone 2008, table 10.1: 855 flops
// of six joints), of Newton-Euler (836) and of a solution with it (187).
TEST_P(KernelSpeed, RungeKuttaStep) {
  Robot robot = SampleRobot("UR5 6R");
  std::mt19937_64 random(1);
  SetRandomInertials(&random, &robot);
  const BatchRollout rollout({{robot, {}, {}}}, *GetParam());
  const auto hold = [](const BatchRollout::Batch& at, double* begin,
                       double* end) {
    std::fill_n(begin, 6 * at.stride, 0.);
    std::fill_n(end, 6 * at.stride, 0.);
  };
  constexpr int kWindows = 32, kSteps = 8;
  RolloutStates states;
  const double limit = kLimits.at(set()).step;
  const double times = TimesTheFlopLimit(
      set(), 4. * (855 + 836 + 187) * kWindows * kSteps, limit,
      [&] {
        states.q.setConstant(kWindows, 6, .3);
        states.qd.setConstant(kWindows, 6, .5);
      },
      [&] { rollout.Run(0, 1e-3, kSteps, hold, nullptr, &states); });
  std::printf("%s: %.2f times the flop limit\n", set().c_str(), times);
  EXPECT_LE(times, limit);
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, KernelSpeed,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

}  // namespace armcal::kernel_speed_test
