#include "tests/blind/case_plan.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <limits>

namespace armcal {
namespace {

// Cases of the evaluation. One effect: each of the 35 nine times, of which two
// below ENR 0.32 and one more than the six that it needs above.
constexpr std::array<long, kNumStrata> kCases = {150, 60, 35 * 9, 60, 60};
// The bins of an effect's nine cases: about log-uniform from 0.17 to 6. They
// begin elsewhere for each effect, so that every round has all bins.
constexpr std::array<int, 9> kBins = {2, 3, 1, 4, 2, 3, 1, 4, 2};
// One in five of the cases with effects.
constexpr uint32_t kPoorEvery = 5;

std::vector<const HiddenEffect*> Kinds(bool in_catalogue) {
  std::vector<const HiddenEffect*> kinds;
  for (const HiddenEffect& kind : HiddenEffects()) {
    if (kind.in_catalogue == in_catalogue) kinds.push_back(&kind);
  }
  return kinds;
}

Excitation PoorExcitation(uint32_t k) {
  constexpr Excitation kPoor[] = {Excitation::kSlow, Excitation::kSmall,
                                  Excitation::kTwoJoints};
  return kPoor[k % 3];
}

}  // namespace

const char* ExcitationName(Excitation excitation) {
  const char* const names[] = {"rich", "slow", "small", "two_joints"};
  return names[static_cast<int>(excitation)];
}

const char* StratumName(Stratum stratum) {
  const char* const names[] = {"none_rich", "none_poor", "one", "two",
                               "outside"};
  return names[static_cast<int>(stratum)];
}

std::optional<Stratum> StratumOf(const std::string& name) {
  for (int s = 0; s < kNumStrata; ++s) {
    const Stratum stratum = static_cast<Stratum>(s);
    if (name == StratumName(stratum)) return stratum;
  }
  return std::nullopt;
}

int EnrBin(double enr) {
  int bin = 0;
  while (bin + 1 < kNumEnrBins && enr >= kEnrBins[bin + 1]) ++bin;
  return bin;
}

double CasePlan::least_enr() const { return kEnrBins[lowest_bin]; }

double CasePlan::most_enr() const {
  return highest_bin + 1 < kNumEnrBins
             ? kEnrBins[highest_bin + 1]
             : std::numeric_limits<double>::infinity();
}

uint32_t EvaluationCases() {
  long sum = 0;
  for (const long cases : kCases) sum += cases;
  return static_cast<uint32_t>(sum);
}

CasePlan PlanCase(Stratum stratum, uint32_t k) {
  CasePlan plan;
  plan.stratum = stratum;
  if (stratum == Stratum::kNoneRich) return plan;
  if (stratum == Stratum::kNonePoor) {
    plan.excitation = PoorExcitation(k);
    return plan;
  }
  const auto kinds = Kinds(stratum != Stratum::kOutside);
  const uint32_t effect = k % kinds.size(), round = k / kinds.size();
  // Of another effect in every round, where their number is a multiple of 5.
  const uint32_t turn = k + round;
  if (turn % kPoorEvery == kPoorEvery - 1) {
    plan.excitation = PoorExcitation(turn / kPoorEvery);
  }
  plan.effect = kinds[effect];
  if (stratum == Stratum::kOne) {
    plan.lowest_bin = plan.highest_bin = kBins[(round + effect) % kBins.size()];
  }
  return plan;
}

CasePlan PlanCase(const HiddenEffect& effect, uint32_t k) {
  const auto kinds = Kinds(true);
  const auto at = std::find(kinds.begin(), kinds.end(), &effect);
  CHECK(at != kinds.end()) << effect.name << " is not in the catalogue";
  return PlanCase(Stratum::kOne, static_cast<uint32_t>(k * kinds.size() +
                                                       (at - kinds.begin())));
}

CasePlan PlanCase(uint32_t index) {
  // The stratum that is furthest behind its share is next.
  std::array<long, kNumStrata> drawn = {};
  const long total = EvaluationCases();
  for (uint32_t k = 0;; ++k) {
    int next = 0;
    long furthest = 0;
    for (int s = 0; s < kNumStrata; ++s) {
      const long behind = (k + 1l) * kCases[s] - total * drawn[s];
      if (s > 0 && behind <= furthest) continue;
      next = s;
      furthest = behind;
    }
    if (k == index) return PlanCase(static_cast<Stratum>(next), drawn[next]);
    ++drawn[next];
  }
}

}  // namespace armcal
