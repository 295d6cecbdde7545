#include "tests/blind/sized_case.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "tests/blind/size_search.h"

namespace armcal {
namespace {

// Draws after which the nearest is good enough, and after which an arm that
// never followed is a bug.
constexpr uint32_t kDraws = 3, kMostDraws = 10 * kDrawsOfAnArm;

ScenarioRun Run(const BlindCase& blind, BlindLog log) {
  return RunScenario(BlindScenario(blind, log, blind.effects));
}

// Sizes the effects one after the other, each beside those before. False where
// the arm does not follow with any size of one.
bool SizeEffects(EffectSizer* sizer, SizedCase* sized) {
  BlindCase& blind = sized->blind;
  std::vector<ChosenEffect> effects;
  for (size_t k = 0; k < blind.effects.size(); ++k) {
    const auto found =
        FindSize(blind.effects[k], blind.aims[k], [&](const ChosenEffect& e) {
          std::vector<ChosenEffect> all = effects;
          all.push_back(e);
          return sizer->SizeOfLast(all);
        });
    if (!found) return false;
    effects.push_back(found->effect);
    sized->limits.push_back(found->limit);
  }
  const auto sizes = sizer->Sizes(effects);
  if (!sizes) return false;
  blind.effects = effects;
  sized->sizes = *sizes;
  return true;
}

// How far the sizes are from what they were to be, in log ENR.
double Distance(const SizedCase& sized) {
  const CasePlan& plan = sized.blind.plan;
  double distance = 0;
  for (const EffectSize& size : sized.sizes) {
    const double enr = std::max(size.enr, 1e-6);
    distance +=
        std::log(std::max({1., plan.least_enr() / enr, enr / plan.most_enr()}));
  }
  return distance;
}

// Where two effects hide each other, sizes that were found one after the other
// are no longer what they were.
void NoteHidden(SizedCase* sized) {
  for (size_t k = 0; k < sized->sizes.size(); ++k) {
    if (sized->limits[k].empty() &&
        sized->sizes[k].enr < sized->blind.plan.least_enr()) {
      sized->limits[k] = "changed by the other effect";
    }
  }
}

// The oracle's gap and the logs; false where the arm does not follow.
bool Finish(EffectSizer* sizer, SizedCase* sized) {
  if (sizer) {
    sized->oracle = FindOracleGap(sized->blind, sizer);
    if (!sized->oracle) return false;
  }
  sized->training = Run(sized->blind, BlindLog::kTraining);
  if (!Follows(sized->training.run)) return false;
  sized->validation = Run(sized->blind, BlindLog::kValidation);
  return Follows(sized->validation.run);
}

}  // namespace

SizedCase DrawSizedCase(uint64_t seed, const CasePlan& plan) {
  std::optional<EffectSizer> sizer;  // of an arm without its effects
  std::optional<SizedCase> best;
  for (uint32_t attempt = 0; attempt < kMostDraws; ++attempt) {
    if (attempt >= kDraws && best) break;
    SizedCase sized;
    sized.blind = DrawBlindCase(seed, plan, attempt);
    if (attempt % kDrawsOfAnArm == 0 && !sized.blind.effects.empty()) {
      sizer.emplace(sized.blind);
    }
    sized.attempt = attempt;
    if (sizer && !SizeEffects(&*sizer, &sized)) continue;
    if (best && Distance(sized) >= Distance(*best)) continue;
    if (!Finish(sizer ? &*sizer : nullptr, &sized)) continue;
    NoteHidden(&sized);
    best = sized;
    if (Distance(sized) == 0) break;
  }
  CHECK(best) << "case " << seed << ": its arm never follows";
  return *best;
}

void AddMisfit(SizedCase* sized) {
  const Log log = sized->training.run.log;
  BlindCase& blind = sized->blind;
  for (uint32_t attempt = 0; attempt < kMostDraws; ++attempt) {
    blind.misfit =
        DrawMisfit(blind.seed, attempt, blind.robot, blind.zero_velocity, log);
    sized->training = Run(blind, BlindLog::kTraining);
    if (!Follows(sized->training.run)) continue;
    sized->validation = Run(blind, BlindLog::kValidation);
    if (Follows(sized->validation.run)) return;
  }
  LOG(FATAL) << "case " << blind.seed << ": with a misfit it never follows";
}

}  // namespace armcal
