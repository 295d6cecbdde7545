// 3 robots x 2 noise levels x 4 robot files: 24 physically consistent fits and
// how well they predict, beside the linear estimate, which is not constrained.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::nonlinear_starts_long_test {

enum class Start { kNear, kFar, kLight, kHeavy };

// A file of the truth's robot that knows no joint terms.
Robot FileOf(const Robot& truth, Start start, std::mt19937_64* random) {
  Robot file = truth;
  for (Link& link : file.links) {
    const Vector10d V = link.inertial.ToVector();
    switch (start) {
      case Start::kNear:
        link.inertial = DrawAround(link.inertial, .3, random);
        break;
      case Start::kFar:
        link.inertial = DrawAround(link.inertial, 1, random);
        break;
      case Start::kLight:
        link.inertial = InertialParameters::FromVector(.3 * V);
        break;
      case Start::kHeavy:
        link.inertial = InertialParameters::FromVector(3 * V);
        break;
    }
    link.joint.viscous = link.joint.coulomb = 0;
    link.joint.armature = link.joint.offset = 0;
  }
  return file;
}

const char* NameOf(Start start) {
  switch (start) {
    case Start::kNear:
      return "off by 0.3";
    case Start::kFar:
      return "off by 1";
    case Start::kLight:
      return "x 0.3";
    case Start::kHeavy:
      return "x 3";
  }
  return "";
}

// Held-out errors of the same fit with other noise and motions, in % of the
// torque: of the estimate against torque without noise, since noise in the
// held-out log would hide the difference of two estimates behind its own size.
struct HeldOut {
  std::vector<double> linear, physical;

  double Ratio(size_t k) const { return physical[k] / linear[k]; }
  // Of root mean squares: one draw's ratio is chance as well.
  double Ratio() const { return Rms(physical) / Rms(linear); }
  long Better() const {
    return std::inner_product(physical.begin(), physical.end(), linear.begin(),
                              0L, std::plus<>(), std::less<>());
  }
  static double Rms(const std::vector<double>& x) {
    return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.) /
                     static_cast<double>(x.size()));
  }
};

constexpr int kDraws = 10;

// The truth stays; files, motions and noise are drawn.
HeldOut Fit(const Robot& truth, Start start, double noise, double trust) {
  HeldOut held_out;
  for (int draw = 1; draw <= kDraws; ++draw) {
    SCOPED_TRACE("draw " + std::to_string(draw));
    std::mt19937_64 files(100 + draw);
    std::mt19937_64 logs(draw);  // the same for every file
    const SimulatedArm arm{FileOf(truth, start, &files), truth};
    NonlinearCalibrationOptions options;
    options.trust.inertia = trust;
    const NonlinearRun run =
        Calibrate(arm, noise, options, &logs, GeometryKnowledge::kKnown, 0);
    EXPECT_TRUE(run.physical.converged()) << run.physical.reason;
    if (!run.physical.validation) return held_out;
    for (const Link& link : run.physical.robot.links) {
      EXPECT_EQ(WhyUnphysical(link.inertial), "") << link.name;
    }
    held_out.linear.push_back(run.linear.validation->moving().stacked_percent);
    held_out.physical.push_back(
        run.physical.validation->moving().stacked_percent);
  }
  return held_out;
}

class Starts : public testing::TestWithParam<const char*> {
 protected:
  // The ratio of held-out errors, printed with what it is made of.
  double Ratio(Start start, double noise, double trust) const {
    std::mt19937_64 random(1);
    const SimulatedArm arm = MakeArm(GetParam(), .3, &random);
    SCOPED_TRACE(NameOf(start) + std::string(", noise ") +
                 std::to_string(noise));
    const HeldOut held_out = Fit(arm.truth, start, noise, trust);
    if (held_out.linear.size() != kDraws) return std::nan("");
    std::printf(
        "%-9s file %-10s trust %.1f noise %4.1f %%  linear %.4f %%  "
        "physical %.4f %%  ratio %.3f  of draw 1 %.3f  better %2ld of %d\n",
        GetParam(), NameOf(start), trust, 100 * noise,
        HeldOut::Rms(held_out.linear), HeldOut::Rms(held_out.physical),
        held_out.Ratio(), held_out.Ratio(0), held_out.Better(), kDraws);
    return held_out.Ratio();
  }
};

constexpr double kDefault = .5;  // the tool's trust
constexpr Start kStarts[] = {Start::kNear, Start::kFar, Start::kLight,
                             Start::kHeavy};

// In the mean over files. Of the twelve, one is beyond 5 %: 3R off by 1, 9 %
// above the linear estimate, nearly all of it from one draw, whose file has
// bodies up to 4.8 times too light in a direction, more than a trust of 0.5
// says. With a trust of 1 it is 2 % (below).
TEST_P(Starts, LowNoiseDefaultTrust) {
  double sum = 0;
  for (const Start start : kStarts) sum += Ratio(start, .005, kDefault);
  EXPECT_LT(sum / std::size(kStarts), 1.05);
}

// Every file, with a trust that does not claim more than is so.
TEST_P(Starts, LowNoiseHonestTrust) {
  for (const Start start : kStarts) {
    EXPECT_LT(Ratio(start, .005, start == Start::kNear ? kDefault : 1), 1.05);
  }
}

// Every file.
TEST_P(Starts, HighNoise) {
  for (const Start start : kStarts) {
    EXPECT_LT(Ratio(start, .1, kDefault), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(, Starts,
                         testing::Values("3R elbow", "UR5 6R", "Panda 7R"));

}  // namespace armcal::nonlinear_starts_long_test
