// Campaigns of measured poses drawn at random, each with none, one or two
// effects in laws of their own (tests/fixtures/hidden_poses.h), of which the
// geometry leaves 3 to 30 times the noise. ARMCAL_RUNS sets how many (60),
// ARMCAL_SEED which.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "calib/poses/diagnosis/diagnosis.h"
#include "calib/poses/fit.h"
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
    // One that no geometry leaves cannot be told, nor is one of .3 usual.
    if (known || effect.size == 1e-3 || effect.size > .3) continue;
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

TEST(Campaigns, EffectsAreNamedInTheirPlaceAndNothingWhereThereIsNone) {
  const std::uint64_t runs = FromEnvironment("ARMCAL_RUNS", 60);
  const std::uint64_t seed = FromEnvironment("ARMCAL_SEED", 1);
  int effects = 0, named = 0, free = 0, false_alarms = 0;
  for (std::uint64_t k = 0; k < runs; ++k) {
    const Campaign campaign = Draw(1000003 * seed + k);
    const PoseDiagnosis diagnosis = DiagnosePoseGap(
        campaign.arm.nominal(),
        campaign.arm.Measure(campaign.effects, campaign.noise, k), {});
    if (campaign.effects.empty()) {
      ++free;
      false_alarms += !diagnosis.findings.empty();
    }
    for (const HiddenPoseEffect& effect : campaign.effects) {
      const bool is_named = IsNamed(diagnosis, effect);
      ++effects;
      named += is_named;
      if (!is_named) {
        std::printf("campaign %d: %s missed\n", static_cast<int>(k),
                    effect.name.c_str());
      }
    }
  }
  std::printf(
      "%d of %d effects named, %d of %d campaigns without one with a "
      "finding\n",
      named, effects, false_alarms, free);
  EXPECT_GE(named, .95 * effects);
  EXPECT_LE(false_alarms, std::ceil(.01 * free));
}

}  // namespace armcal::campaigns_long_test
