#include "calib/diagnose/candidates/candidates.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "calib/diagnose/candidates/proposals.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Search = EffectParameter::Search;

constexpr size_t kEverywhere = 5;  // larger sizes that are tried at every place

// What the nonlinear parameters of an effect may be.
struct Shape {
  VectorXd p;
  int log = -1;
};

std::vector<Shape> Expand(const std::vector<Shape>& shapes, int k,
                          const std::vector<double>& values) {
  std::vector<Shape> more;
  for (const Shape& shape : shapes) {
    for (const double value : values) {
      more.push_back(shape);
      more.back().p[k] = value;
    }
  }
  return more;
}

// Shapes at the times that stand out, in the log that they are of. `tried`
// counts how many windows were looked through, not how many are left: the
// penalty of what happened once is that of a search over all of the time.
std::vector<Shape> AtTimes(const Effect& effect, const GapProposals& proposals,
                           const std::vector<Shape>& shapes, int* tried) {
  std::vector<Shape> windows;
  int all = 0;
  for (int log = 0; log < proposals.num_logs(); ++log) {
    int searched = 0;
    for (const TimeWindow& window : proposals.Windows(log, &searched)) {
      for (Shape shape : shapes) {
        for (size_t k = 0; k < effect.parameters.size(); ++k) {
          const Search search = effect.parameters[k].search;
          if (search == Search::kTime) shape.p[k] = window.centre;
          if (search == Search::kDuration) shape.p[k] = window.duration / 2;
        }
        shape.log = log;
        windows.push_back(shape);
      }
    }
    all += searched;
  }
  *tried *= std::max(1, all);
  return windows;
}

// All combinations of values of an effect's nonlinear parameters, a Cartesian
// product. Frequencies come from peaks of the residual and not from a grid, of
// which one fine enough to hit an oscillation would have thousands; `tried`
// counts those that the search passed, since that is what they were chosen
// from.
std::vector<Shape> Shapes(const Effect& effect, const EffectSite& site,
                          const GapProposals& proposals, int* tried) {
  // Frequencies that a search passes.
  constexpr int kHarmonics = 200, kFrequencies = 400;
  std::vector<Shape> shapes = {{VectorXd::Zero(effect.parameters.size())}};
  *tried = 1;
  bool happens_once = false;
  for (size_t i = 0; i < effect.parameters.size(); ++i) {
    const int k = static_cast<int>(i);
    const EffectParameter& parameter = effect.parameters[i];
    switch (parameter.search) {
      case Search::kLinear:
        break;
      case Search::kGrid:
      case Search::kRefined: {
        std::vector<double> grid = parameter.grid(site);
        if (parameter.search == Search::kRefined) {
          grid = {grid.begin() + 1, grid.end() - 1};
        }
        shapes = Expand(shapes, k, grid);
        *tried *= static_cast<int>(grid.size());
        break;
      }
      case Search::kPositionFrequency:
        shapes = Expand(shapes, k, proposals.Harmonics(site.joint));
        *tried *= kHarmonics;
        break;
      case Search::kTimeFrequency:
        shapes = Expand(shapes, k, proposals.Frequencies(site.joint));
        *tried *= kFrequencies;
        break;
      case Search::kTime:
      case Search::kDuration:
        happens_once = true;
        break;
    }
  }
  return happens_once ? AtTimes(effect, proposals, shapes, tried) : shapes;
}

// Odds of a hypothesis before the data add their logarithm to its log
// likelihood, of which a score is 2 T times as large, T being the temperature
// that scores are divided by.
double PenaltyOfOdds(double odds) {
  return 2 * Limits().temperature * std::log(odds);
}

// What is carried is at the tool, which is there for that, or on some other
// link: one body on a link of n is one hypothesis, as probable before the data
// as a payload is, and each of these links has an n-th of it. A body on the
// last joint's axis turns nothing but the joints before it, as one on the link
// before does: where data cannot tell these two, neither is named alone because
// there are many links.
void ShareOddsOfLinks(std::vector<GapCandidate>* candidates) {
  std::set<int> links;
  const auto is_on_a_link = [](const GapCandidate& candidate) {
    return IsCarriedBody(*candidate.effect) && candidate.joint >= 0;
  };
  for (const GapCandidate& candidate : *candidates) {
    if (is_on_a_link(candidate)) links.insert(candidate.joint);
  }
  for (GapCandidate& candidate : *candidates) {
    if (!is_on_a_link(candidate)) continue;
    candidate.prior_penalty += PenaltyOfOdds(static_cast<double>(links.size()));
  }
}

// Bodies, and laws that are no friction (springs and what is like them): less
// friction is told by that of another day.
bool MayBeLess(const Effect& effect) {
  if (IsCarriedBody(effect)) return true;
  return effect.nature == Effect::Nature::kLaw && effect.proportional &&
         !IsCoulombInFiles(effect);
}

// Candidates of one effect at one place, a column per linear parameter, each in
// units of a size that matters to the motion (EffectParameter::size), so that
// coefficients of all candidates are of the order of 1. Those of which that
// size is undefined, as of a joint that never moves, are left out.
void ListShapes(const Effect& effect, const EffectSite& site,
                const GapProposals& proposals, bool since_reference,
                std::vector<GapCandidate>* candidates) {
  if (effect.unfit && !effect.unfit(site).empty()) return;
  int tried = 1;
  for (const Shape& shape : Shapes(effect, site, proposals, &tried)) {
    GapCandidate candidate;
    candidate.effect = &effect;
    candidate.joint = site.joint;
    candidate.p = shape.p;
    candidate.log = shape.log;
    candidate.tried = tried;
    candidate.prior_penalty = PriorPenalty(effect, since_reference);
    candidate.is_change = since_reference && MayBeLess(effect);
    for (size_t k = 0; k < effect.parameters.size(); ++k) {
      if (effect.parameters[k].search != Search::kLinear) {
        const double usual = effect.parameters[k].size(site);
        if (candidate.p[k] != usual) candidate.is_usual = false;
        continue;
      }
      candidate.linear.push_back(static_cast<int>(k));
      candidate.size.conservativeResize(candidate.linear.size());
      candidate.size[candidate.size.size() - 1] =
          effect.parameters[k].size(site);
    }
    if (candidate.size.allFinite() && (candidate.size.array() > 0).all()) {
      candidates->push_back(candidate);
    }
  }
}

}  // namespace

double PriorPenalty(const Effect& effect, bool since_reference) {
  double penalty = effect.near_zero ? Limits().near_zero_penalty : 0;
  if (since_reference && effect.of_construction) {
    penalty += PenaltyOfOdds(Limits().odds_of_same_construction);
  }
  return penalty;
}

bool IsCoulombInFiles(const Effect& law) {
  const std::vector<JointTerm>& terms = law.stand_ins;
  return std::count(terms.begin(), terms.end(), JointTerm::kCoulomb) > 0;
}

std::string GapCandidate::place() const {
  return effect->name + (joint < 0 ? "" : "@" + std::to_string(joint + 1));
}

bool SamePlace(const GapCandidate& a, const GapCandidate& b) {
  return a.effect == b.effect && a.joint == b.joint;
}

std::vector<GapCandidate> AllBut(std::vector<GapCandidate> effects, size_t k) {
  effects.erase(effects.begin() + static_cast<long>(k));
  return effects;
}

std::vector<GapCandidate> ListCandidates(
    const GapBaseline& baseline, const GapRows& rows, const MotionScale& scale,
    const MatrixXd& residual, const std::vector<std::string>& without,
    bool since_reference) {
  const GapProposals proposals(rows, residual);
  std::vector<GapCandidate> candidates;
  for (const Effect& effect : Effects()) {
    if (std::count(without.begin(), without.end(), effect.name) > 0) continue;
    const bool whole = effect.scope == Effect::Scope::kRobot;
    for (int j = whole ? -1 : 0; j < (whole ? 0 : rows.num_joints()); ++j) {
      ListShapes(effect, {&baseline.robot(), j, &scale}, proposals,
                 since_reference, &candidates);
    }
  }
  ShareOddsOfLinks(&candidates);
  return candidates;
}

bool SwingsInTime(const Effect& effect) {
  return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                     [](const EffectParameter& parameter) {
                       return parameter.search ==
                              EffectParameter::Search::kTimeFrequency;
                     });
}

std::vector<GapCandidate> LargerOnes(const GapCandidate& candidate) {
  std::vector<GapCandidate> larger;
  for (const double multiple : candidate.effect->larger_sizes) {
    larger.push_back(candidate);
    larger.back().size *= multiple;
    larger.back().tried *= 1 + candidate.effect->larger_sizes.size();
    larger.back().is_larger = true;
    // To where the next sizes are nearer.
    larger.back().least = .5;
    larger.back().most = 2;
    larger.back().torque.clear();
  }
  return larger;
}

bool HasMoreLargerOnes(const GapCandidate& candidate) {
  return candidate.effect->larger_sizes.size() > kEverywhere;
}

std::vector<GapCandidate> FewLargerOnes(const GapCandidate& candidate) {
  const std::vector<GapCandidate> all = LargerOnes(candidate);
  if (!HasMoreLargerOnes(candidate)) return all;
  std::vector<GapCandidate> few;
  for (size_t k = 0; k < kEverywhere; ++k) {
    few.push_back(all[(2 * k + 1) * all.size() / (2 * kEverywhere)]);
  }
  return few;
}

std::vector<int> UsualShapes(const std::vector<GapCandidate>& candidates) {
  std::vector<int> usual;
  for (size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].effect->larger_sizes.empty()) continue;
    const auto same = std::find_if(usual.begin(), usual.end(), [&](int other) {
      return SamePlace(candidates[other], candidates[i]);
    });
    const int index = static_cast<int>(i);
    if (same == usual.end()) {
      usual.push_back(index);
    } else if (candidates[i].is_usual && !candidates[*same].is_usual) {
      *same = index;
    }
  }
  return usual;
}

bool HasShape(const GapCandidate& candidate) {
  return candidate.linear.size() < candidate.effect->parameters.size() ||
         !candidate.effect->larger_sizes.empty();
}

// A candidate at the shape that a fit found, its linear parameters 0 and in
// units of their fitted values: the column then is the effect's torque at that
// size, which for what grows otherwise than linearly is not the derivative at
// 0. A quarter away from that size its course would be another one.
std::vector<GapCandidate> Sharper(const std::vector<GapCandidate>& effects) {
  std::vector<GapCandidate> sharper;
  for (GapCandidate effect : effects) {
    if (!HasShape(effect)) continue;
    for (size_t l = 0; l < effect.linear.size(); ++l) {
      double& p = effect.p[effect.linear[l]];
      // A size matters to what grows with it otherwise than linearly.
      if (!effect.effect->larger_sizes.empty() && p != 0) {
        effect.size[l] = p;
        effect.least = .8;
        effect.most = 1.25;
      }
      p = 0;
    }
    effect.is_larger = effect.is_fitted = true;
    effect.torque.clear();
    sharper.push_back(effect);
  }
  return sharper;
}

void AddCandidates(const GapRows& rows, std::vector<GapCandidate>* candidates,
                   GapScreen* screen) {
  for (GapCandidate& candidate : *candidates) {
    candidate.columns.clear();
    for (const JointRows& torque : candidate.torque) {
      JointRows column(torque.size());
      for (size_t j = 0; j < torque.size(); ++j) {
        if (torque[j].size() == 0) continue;
        column[j] = rows.Whiten(static_cast<int>(j), torque[j]);
      }
      candidate.columns.push_back(screen->AddColumn(std::move(column)));
    }
  }
}

}  // namespace armcal
