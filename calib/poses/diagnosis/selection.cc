#include "calib/poses/diagnosis/selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calib/poses/diagnosis/scan.h"
#include "calib/poses/some_poses.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Models that the search goes on from, models that are fitted a round.
constexpr size_t kBeam = 3, kFitsOfRound = 8;
// Of one effect among these.
constexpr int kOfOneEffect = 2;
constexpr size_t kMostEffects = 6;
// Rounds without a better model before the search ends.
constexpr int kPatience = 2;

// Effects of far amounts are looked for in so many poses, and fitted to all
// where -2 log p falls by so much there.
constexpr int kMostFarPoses = 60;
constexpr double kFarGain = 20;

// A model gives poses up that have less than this of the weight of one that
// fits well, which no effect is seen by.
constexpr double kLittleWeight = .3;

bool GivesUpPoses(const PoseModel& model) {
  return model.estimate.errors.weights.minCoeff() < kLittleWeight;
}

struct Extension {
  size_t from;
  ScannedEffect scanned;
  double evidence;  // to first order
};

class EffectSearch {
 public:
  explicit EffectSearch(const PoseStudy& study) : study_(study) {}

  PoseSelection Run(const PoseModel& alone) {
    result_.models = {alone};
    AddFarAmounts(alone);
    std::vector<size_t> beam = Beam(0);
    int waiting = 0;
    for (size_t round = 1; round <= kMostEffects && waiting < kPatience;
         ++round) {
      const PoseModel before = Best();
      for (const Extension& extension : Extend(beam)) Fit(extension);
      Rank();
      beam = Beam(round);
      if (beam.empty()) break;
      waiting = Best().effects == before.effects ? waiting + 1 : 0;
    }
    Prune();
    // While the search goes on errors count as independent, since those of a
    // small model are alike because it lacks something. The likeliest model
    // says how much they are.
    result_.design_effect = DesignEffect(study_, Best());
    Rank();
    return result_;
  }

 private:
  const PoseModel& Best() const { return result_.models[0]; }

  bool Has(const std::vector<PlacedPoseEffect>& effects) const {
    return std::any_of(
        result_.models.begin(), result_.models.end(), [&](const PoseModel& m) {
          return m.effects.size() == effects.size() &&
                 std::is_permutation(effects.begin(), effects.end(),
                                     m.effects.begin());
        });
  }

  void Rank() {
    result_.evidence.clear();
    for (const PoseModel& model : result_.models) {
      result_.evidence.push_back(
          EvidenceOf(study_, model, result_.design_effect));
    }
    std::vector<size_t> order(result_.models.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return result_.evidence[a] < result_.evidence[b];
    });
    std::vector<PoseModel> models;
    std::vector<double> evidence;
    for (const size_t k : order) {
      models.push_back(std::move(result_.models[k]));
      evidence.push_back(result_.evidence[k]);
    }
    result_.models = std::move(models);
    result_.evidence = std::move(evidence);
  }

  // The best models of so many effects, not more than some of one last effect.
  std::vector<size_t> Beam(size_t size) const {
    std::vector<size_t> beam;
    std::vector<const PoseEffect*> last;
    for (size_t k = 0; k < result_.models.size(); ++k) {
      if (result_.models[k].effects.size() != size) continue;
      const PoseEffect* effect =
          size > 0 ? result_.models[k].effects.back().effect : nullptr;
      if (std::count(last.begin(), last.end(), effect) > 0 && size == 1) {
        continue;
      }
      last.push_back(effect);
      beam.push_back(k);
      if (beam.size() == kBeam) break;
    }
    return beam;
  }

  std::vector<Extension> Extend(const std::vector<size_t>& beam) const {
    std::vector<Extension> all;
    for (const size_t k : beam) {
      const PoseModel& model = result_.models[k];
      const double evidence = EvidenceOf(study_, model, result_.design_effect);
      for (const bool equal : {false, true}) {
        if (equal && !GivesUpPoses(model)) continue;
        for (ScannedEffect& scanned : ScanEffects(study_, model, equal)) {
          all.push_back({k, scanned, evidence + scanned.score});
        }
      }
    }
    std::sort(all.begin(), all.end(),
              [](const Extension& a, const Extension& b) {
                return a.evidence < b.evidence;
              });
    std::vector<Extension> some;
    for (const Extension& next : all) {
      const auto alike =
          std::count_if(some.begin(), some.end(), [&](const Extension& o) {
            return o.from == next.from &&
                   o.scanned.placed.effect == next.scanned.placed.effect;
          });
      if (alike >= kOfOneEffect) continue;
      some.push_back(next);
      if (some.size() == kFitsOfRound) break;
    }
    return some;
  }

  void Fit(const Extension& extension) {
    const PoseModel& from = result_.models[extension.from];
    std::vector<PlacedPoseEffect> effects = from.effects;
    effects.push_back(extension.scanned.placed);
    if (Has(effects)) return;
    Add(FitPoseModel(study_, effects, from,
                     VectorXd::Zero(extension.scanned.amounts.size())));
  }

  void Add(PoseModel model) {
    if (!Has(model.effects) && IsPossible(model)) {
      result_.models.push_back(std::move(model));
    }
  }

  // Effects that act by far more than a first order sees, of which some poses
  // are enough to see them.
  void AddFarAmounts(const PoseModel& alone) {
    const PoseMeasurements some = SomePoses(study_.measured, kMostFarPoses);
    PoseStudy part = {study_.arm, some, study_.equations.Of(some), study_.nu,
                      study_.without};
    const PoseModel part_alone = FitGeometryAlone(part, alone.estimate.state);
    for (const PoseEffect& effect : PoseEffects()) {
      if (std::count(study_.without.begin(), study_.without.end(),
                     effect.name)) {
        continue;
      }
      PoseModel best = part_alone;
      for (const PosePlace& place : effect.places(part_alone.campaign)) {
        for (const double amount : effect.far_amounts) {
          PoseModel far = FitPoseModel(part, {{&effect, place}}, part_alone,
                                       VectorXd::Constant(1, amount));
          if (far.estimate.Cost() < best.estimate.Cost()) best = std::move(far);
        }
      }
      if (best.effects.empty() ||
          part_alone.estimate.Cost() - best.estimate.Cost() < kFarGain) {
        continue;
      }
      Add(FitPoseModel(study_, best.effects, alone,
                       best.estimate.state.amounts));
    }
    Rank();
  }

  // Models without one of the best's effects, or with another form of it: an
  // effect that others have taken the place of goes.
  void Prune() {
    for (bool better = true; better && !Best().effects.empty();) {
      const PoseModel best = Best();
      for (size_t out = 0; out < best.effects.size(); ++out) {
        const PoseModel without = FitWithout(study_, best, out);
        AddOtherForms(best.effects[out], without);
        Add(without);
      }
      Rank();
      better = Best().effects != best.effects;
    }
  }

  void AddOtherForms(const PlacedPoseEffect& own, const PoseModel& without) {
    for (PosePlace place : own.effect->places(without.campaign)) {
      if (place.joint != own.place.joint || place.by != own.place.by) continue;
      place.begin = own.place.begin;
      place.end = own.place.end;
      std::vector<PlacedPoseEffect> effects = without.effects;
      effects.push_back({own.effect, place});
      if (Has(effects)) continue;
      const size_t terms = own.effect->terms(without.campaign, place).size();
      Add(FitPoseModel(study_, effects, without, VectorXd::Zero(terms)));
    }
  }

  const PoseStudy& study_;
  PoseSelection result_;
};

}  // namespace

PoseSelection SelectEffects(const PoseStudy& study, const PoseModel& alone) {
  EffectSearch search(study);
  return search.Run(alone);
}

}  // namespace armcal
