// Campaigns of measured poses drawn at random, each with none, one or two
// effects in laws of their own (tests/fixtures/hidden_poses.h), of which the
// geometry leaves 3 to 30 times the noise; what is named, where, and whether
// intervals hold the hidden laws' own parameters. ARMCAL_RUNS sets how many
// (60), ARMCAL_SEED which.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "calib/poses/diagnosis/diagnosis.h"
#include "calib/poses/fit.h"
#include "calib/poses/pose_solution.h"
#include "tests/fixtures/hidden_poses.h"

namespace armcal::campaigns_long_test {

std::uint64_t FromEnvironment(const char* name, std::uint64_t usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::strtoull(text, nullptr, 10);
}

// Logarithmically even.
double DrawSize(double least, double most, std::mt19937_64* random) {
  return std::exp(Uniform(random, std::log(least), std::log(most)));
}

// rms of what the refined geometry leaves of exact poses with an effect.
double GeometryLeaves(const Robot& robot, const PoseMeasurements& poses) {
  PoseCalibrationOptions options;
  options.loss = RobustLoss::kSquared;
  PoseFit fit(robot, poses, options);
  const PoseSolution solution = SolvePoses(poses, RefineGeometry::kAll, &fit);
  if (!solution.refusal.empty()) return 0;
  PoseNoise one;
  one.position = one.rotation = 1;
  fit.set_noise(one);
  const Eigen::VectorXd left = fit.Residuals(fit.AllRows(), solution.unknowns);
  return std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
}

struct Campaign {
  HiddenPoses arm;
  Instrument instrument;
  double noise;  // m
  std::vector<HiddenPoseEffect> effects;
};

Campaign Draw(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const char* names[] = {"PUMA560 6R", "UR5 6R", "Panda 7R",
                         "KUKA iiwa/LBR 7R"};
  const std::string name = names[static_cast<int>(Uniform(&random, 0, 4))];
  const double which = Uniform(&random, 0, 1);
  const Instrument instrument = which < .6    ? Instrument::kTargets
                                : which < .85 ? Instrument::kPoses
                                              : Instrument::kWire;
  const int targets = Uniform(&random, 0, 1) < .5 ? 1 : 3;
  const int poses = instrument == Instrument::kWire
                        ? 150
                        : static_cast<int>(Uniform(&random, 30, 150));
  const double noise = DrawSize(2e-5, 3e-4, &random);
  Campaign campaign{HiddenPoses(name, instrument, targets, poses, random()),
                    instrument,
                    noise,
                    {}};
  const auto count = static_cast<size_t>(Uniform(&random, 0, 3));
  while (campaign.effects.size() < count) {
    HiddenPoseEffect effect =
        DrawPoseEffect(campaign.arm.nominal(), instrument, poses, &random);
    bool known = false;
    for (const auto& other : campaign.effects) {
      known = known || other.name == effect.name;
    }
    const double wanted = noise * DrawSize(3, 30, &random);
    effect.size = 1e-3;
    for (int round = 0; round < 2; ++round) {
      const double left = GeometryLeaves(
          campaign.arm.nominal(), campaign.arm.Measure({effect}, 1e-9, 1));
      if (left > 1e-9) effect.size *= std::min(1e3, wanted / left);
    }
    // One that no geometry leaves cannot be told, nor is one of .3 usual, nor
    // an encoder or a gear that errs by more than a degree.
    const bool of_angle =
        effect.name == "eccentricity" || effect.name == "second_harmonic";
    const double most = of_angle ? .02 : .3;
    if (known || effect.size == 1e-3 || effect.size > most) continue;
    if (Uniform(&random, 0, 1) < .5) effect.size *= -1;
    campaign.effects.push_back(effect);
  }
  return campaign;
}

bool IsAt(const PlacedPoseEffect& placed, const HiddenPoseEffect& effect) {
  return placed.effect->name == effect.name &&
         placed.place.joint == effect.joint && placed.place.by == effect.by;
}

// An end of a stretch within two poses.
bool EndsAt(const int (&told)[2], int truth) {
  return truth < 0 || std::abs((told[0] + told[1]) / 2. - truth) <= 2;
}

bool IsNamed(const PoseDiagnosis& diagnosis, const HiddenPoseEffect& effect) {
  const bool drifts = effect.name.find("drift") != std::string::npos;
  for (const PoseFinding& finding : diagnosis.findings) {
    if (IsAt(finding.placed, effect) &&
        (drifts || (EndsAt(finding.begin, effect.begin) &&
                    EndsAt(finding.end, effect.end)))) {
      return true;
    }
    for (const PoseEquivalent& other : finding.equivalents) {
      if (IsAt(other.placed, effect)) return true;
    }
  }
  return false;
}

const PoseFinding* FindingOf(const PoseDiagnosis& diagnosis,
                             const HiddenPoseEffect& effect) {
  for (const PoseFinding& finding : diagnosis.findings) {
    if (IsAt(finding.placed, effect)) return &finding;
  }
  return nullptr;
}

// The middle of what an instrument measured, in its frame, about which a
// frame's rotation is told.
Eigen::Vector3d MiddleOf(const PoseMeasurements& measured) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::MatrixXd& target : measured.targets) {
    middle += target.colwise().mean().transpose() /
              static_cast<double>(measured.targets.size());
  }
  if (measured.poses.size() > 0) {
    middle = measured.poses.leftCols(3).colwise().mean().transpose();
  }
  return middle;
}

// Numbers of a finding that the hidden law has, too, with the half-widths of
// their intervals of 95 %.
struct Comparable {
  Eigen::VectorXd found, half_width, truth;
};

Comparable Amounts(const PoseFinding& finding) {
  const auto size = static_cast<Eigen::Index>(finding.amounts.size());
  Comparable c;
  c.found.resize(size);
  c.half_width.resize(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    c.found[k] = finding.amounts[k].value;
    c.half_width[k] = finding.amounts[k].half_width;
  }
  return c;
}

// The length of `count` amounts from `begin` on.
Comparable LengthOf(const PoseFinding& finding, size_t begin, size_t count,
                    double truth) {
  const auto first = finding.amounts.begin() + static_cast<long>(begin);
  const auto k = static_cast<Eigen::Index>(begin);
  const auto n = static_cast<Eigen::Index>(count);
  const PoseAmount found =
      armcal::LengthOf("length", {first, first + static_cast<long>(count)},
                       finding.ci95.block(k, k, n, n));
  Comparable length;
  length.found = Eigen::VectorXd::Constant(1, found.value);
  length.half_width = Eigen::VectorXd::Constant(1, found.half_width);
  length.truth = Eigen::VectorXd::Constant(1, std::abs(truth));
  return length;
}

// By the hidden law's own parameters, to first order in them. The tool's frame
// is known as well as the geometry, so that a tool's displacement has a length
// alone, and so have the sine and cosine of an angle whose zero is as the
// file's. A drift's curve has no knots: where it ends counts. Empty where
// the law has no such number: springs of each joint beside one of the arm, one
// target's own displacement.
Comparable CompareAmounts(const HiddenPoseEffect& effect,
                          const PoseFinding& finding,
                          const Eigen::Vector3d& middle) {
  const std::string& name = effect.name;
  const PosePlace& place = finding.placed.place;
  const auto is = [&](const char* part) {
    return name.find(part) != std::string::npos;
  };
  if (is("sag") || place.parts < 0) return {};
  Comparable c = Amounts(finding);
  if (is("eccentricity") || is("second_harmonic")) {
    return LengthOf(finding, 0, 2, effect.size);
  }
  double moved = effect.size;
  if (is("drift")) {
    moved *= 1 - std::exp(-1.5);
    if (place.knots == 1) {
      c.found *= 1 - std::exp(-4);
      c.half_width *= 1 - std::exp(-4);
    }
  }
  if (is("tool_")) {
    return LengthOf(finding, finding.amounts.size() - place.parts, 3, moved);
  }
  c.truth = Eigen::VectorXd::Constant(1, moved);
  if (is("frame_")) {
    const Eigen::Vector3d turn =
        .3 * moved * effect.direction.cross(Eigen::Vector3d::UnitZ());
    c.truth.resize(6);
    c.truth << moved * effect.direction + turn.cross(middle), turn;
    c.truth.conservativeResize(place.parts);
  }
  c.found = c.found.tail(c.truth.size()).eval();
  c.half_width = c.half_width.tail(c.truth.size()).eval();
  return c;
}

// How many of the intervals of 95 % hold the truth.
struct Coverage {
  int intervals = 0, hold = 0;

  void Add(int campaign, const HiddenPoseEffect& effect,
           const PoseFinding& finding, const Eigen::Vector3d& middle) {
    const Comparable c = CompareAmounts(effect, finding, middle);
    for (Eigen::Index k = 0; k < c.truth.size(); ++k) {
      ++intervals;
      const bool holds = std::abs(c.found[k] - c.truth[k]) <= c.half_width[k];
      hold += holds;
      if (holds) continue;
      std::printf("campaign %d: %s, number %d: %g +- %g, true %g\n", campaign,
                  finding.name.c_str(), static_cast<int>(k) + 1, c.found[k],
                  c.half_width[k], c.truth[k]);
    }
  }
};

TEST(Campaigns, EffectsAreNamedInTheirPlaceAndNothingWhereThereIsNone) {
  const std::uint64_t runs = FromEnvironment("ARMCAL_RUNS", 60);
  const std::uint64_t seed = FromEnvironment("ARMCAL_SEED", 1);
  int effects = 0, named = 0, free = 0, false_alarms = 0;
  Coverage coverage;
  for (std::uint64_t k = 0; k < runs; ++k) {
    const Campaign campaign = Draw(1000003 * seed + k);
    const PoseMeasurements measured =
        campaign.arm.Measure(campaign.effects, campaign.noise, k);
    const PoseDiagnosis diagnosis =
        DiagnosePoseGap(campaign.arm.nominal(), measured, {});
    if (campaign.effects.empty()) {
      ++free;
      false_alarms += !diagnosis.findings.empty();
    }
    for (const HiddenPoseEffect& effect : campaign.effects) {
      const bool is_named = IsNamed(diagnosis, effect);
      ++effects;
      named += is_named;
      const PoseFinding* finding = FindingOf(diagnosis, effect);
      if (finding != nullptr) {
        coverage.Add(static_cast<int>(k), effect, *finding, MiddleOf(measured));
      }
      if (!is_named) {
        std::printf("campaign %d: %s missed\n", static_cast<int>(k),
                    effect.name.c_str());
      }
    }
  }
  std::printf(
      "%d of %d effects named, %d of %d campaigns without one with a "
      "finding, %d of %d intervals hold the truth\n",
      named, effects, false_alarms, free, coverage.hold, coverage.intervals);
  EXPECT_GE(named, .95 * effects);
  EXPECT_LE(false_alarms, std::ceil(.01 * free));
  EXPECT_GE(coverage.hold, .93 * coverage.intervals);
}

}  // namespace armcal::campaigns_long_test
