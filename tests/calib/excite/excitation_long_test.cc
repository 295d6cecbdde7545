#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "tests/calib/excite/rated_design.h"

namespace armcal::excitation_long_test {

class RatedArms : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Arms, RatedArms,
                         testing::Values("scara", "puma", "ur5", "panda"));

// The volume's ratio is of its m-th root: how much smaller variances are on
// average.
TEST_P(RatedArms, DesignsBeatTheBestOfAThousandRandomMotions) {
  using Clock = std::chrono::steady_clock;
  RatedDesign design(GetParam());
  const RatedDesign::Best random = design.OfRandom();
  double seconds = 0;
  const auto run = [&](ExcitationCriterion criterion) {
    design.options.criterion = criterion;
    const Clock::time_point start = Clock::now();
    const Excitation designed = DesignExcitation(design.robot, design.model,
                                                 design.all, design.options);
    seconds = std::max(
        seconds, std::chrono::duration<double>(Clock::now() - start).count());
    EXPECT_LE(designed.used, 1);
    return designed;
  };
  const Excitation by_volume = run(ExcitationCriterion::kD);
  const Excitation by_worst = run(ExcitationCriterion::kWorst);
  const double volume = std::exp(2 * (by_volume.criterion - random.volume));
  const double worst = std::exp(design.Worst(by_worst) - random.worst);
  const double least = design.LeastWorst() / std::exp(random.worst);
  std::printf(
      "%s: %d parameters, variance %.2f (det^(1/m); determinant 10^%.0f), "
      "worst standard deviation %.2f times the best of 1000 (no motion can: "
      "%.2f), %.0f s; limits used %.4f and %.4f\n",
      GetParam(), design.model.size(), volume,
      design.model.size() * std::log10(volume), worst, least, seconds,
      by_volume.used, by_worst.used);
  EXPECT_LT(volume, .6);
  // Where limits of velocity leave little room for that, near what they leave.
  EXPECT_LT(worst, std::max(.6, 1.8 * least));
}

}  // namespace armcal::excitation_long_test
