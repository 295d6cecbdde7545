#include "calib/poses/diagnosis/scan.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of a column's square: what is less is explained by the others.
constexpr double kUnseenShare = 1e-6;
// Places of an effect that are refined and told.
constexpr size_t kPlacesEach = 3;

class EffectScan {
 public:
  // What all candidates share: the weighted equations of the model as it is,
  // their factor, and the step that they still ask for.
  EffectScan(const PoseStudy& study, const PoseModel& model, bool equal)
      : study_(study), model_(model), at_(model.estimate) {
    if (equal)
      at_.errors = FitStudent(at_.linear.r, study.equations.width(),
                              std::numeric_limits<double>::infinity());
    at_.linear = study.equations.Linearise(model.terms, at_.state, true);
    const MatrixXd own = study.equations.Columns(at_.linear, model.terms);
    MatrixXd J(own.rows(), at_.linear.geometry.cols() + own.cols());
    J << at_.linear.geometry, own;
    J_ = WeightedRows(at_, J);
    r_ = WeightedRows(at_, at_.linear.r);
    MatrixXd A = PoseInformation(study.equations, at_, own);
    A.diagonal().array() += 1e-12;
    factor_.compute(A);
    VectorXd pull = J_.transpose() * r_;
    pull += PriorPull(study.equations, model.terms, at_.state);
    moved_ = factor_.solve(pull);
    chi2_ = r_.squaredNorm() + at_.prior;
    count_ = static_cast<double>(r_.size()) - at_.parameters;
  }

  // To first order, an effect with columns C lowers chi^2 by b'S^-1 b: S = C'C
  // - C'J A^-1 J'C is what geometry and other effects leave of its information
  // and b what they leave of -C'r (Frisch & Waugh 1933; the score test).
  // Directions that are explained by the others are left out. Errors of unknown
  // scale make it N log(1 - gain / chi^2), plus what the evidence asks for.
  ScannedEffect Try(const PlacedPoseEffect& placed) const {
    const auto terms = placed.effect->terms(model_.campaign, placed.place);
    std::vector<Eigen::Index> kept(terms.size());
    std::iota(kept.begin(), kept.end(), 0);
    for (;;) {
      ScannedEffect scanned = Try(placed, terms, kept);
      // Amounts below what there is are 0.
      const auto end = std::remove_if(
          kept.begin(), kept.end(),
          [&](Eigen::Index k) { return scanned.amounts[k] < terms[k].least; });
      if (end == kept.end()) return scanned;
      kept.erase(end, kept.end());
    }
  }

  // With those of its terms that are `kept`.
  ScannedEffect Try(const PlacedPoseEffect& placed,
                    const std::vector<PoseTerm>& all,
                    const std::vector<Eigen::Index>& kept) const {
    ScannedEffect scanned = {placed, VectorXd::Zero(all.size()), 0};
    scanned.score = PriorPenalty(model_.campaign, *placed.effect);
    if (kept.empty()) return scanned;
    std::vector<PoseTerm> terms;
    for (const Eigen::Index k : kept) terms.push_back(all[k]);
    const MatrixXd C =
        WeightedRows(at_, study_.equations.Columns(at_.linear, terms));
    const VectorXd size = C.colwise().norm().cwiseMax(1e-30);
    const VectorXd inverse_size = size.cwiseInverse();
    const MatrixXd shared = J_.transpose() * C;
    MatrixXd S = C.transpose() * C - shared.transpose() * factor_.solve(shared);
    S = inverse_size.asDiagonal() * S * inverse_size.asDiagonal();
    const VectorXd b = inverse_size.cwiseProduct(-C.transpose() * r_ +
                                                 shared.transpose() * moved_);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(S);
    double gain = 0, rank = 0;
    VectorXd amounts = VectorXd::Zero(S.cols());
    for (Eigen::Index k = 0; k < S.cols(); ++k) {
      const double value = eigen.eigenvalues()[k];
      if (value < kUnseenShare) continue;
      const double along = eigen.eigenvectors().col(k).dot(b);
      gain += along * along / value;
      rank += 1;
      amounts += along / value * eigen.eigenvectors().col(k);
    }
    scanned.amounts(kept) = amounts.cwiseProduct(inverse_size);
    const double left = std::max(1e-6, 1 - gain / chi2_);
    scanned.score +=
        count_ * std::log(left) + rank * std::log(std::max(2.0, count_));
    return scanned;
  }

  // The pose where an effect begins or ends, by ever smaller steps.
  void Refine(ScannedEffect* best) const {
    const int poses = model_.campaign.size();
    for (int step = std::max(1, poses / 32); step >= 1; step /= 2) {
      for (bool better = true; better;) {
        better = false;
        for (const int move : {-step, step}) {
          for (int PosePlace::*side : {&PosePlace::begin, &PosePlace::end}) {
            PlacedPoseEffect next = best->placed;
            if (next.place.*side < 0) continue;
            next.place.*side += move;
            const int end = next.place.end < 0 ? poses : next.place.end;
            if (next.place.begin < 1 || end > poses) continue;
            if (end - next.place.begin < 2) continue;
            const ScannedEffect tried = Try(next);
            if (tried.score >= best->score) continue;
            *best = tried;
            better = true;
          }
        }
      }
    }
  }

 private:
  const PoseStudy& study_;
  const PoseModel& model_;
  PoseEstimate at_;
  MatrixXd J_;
  VectorXd r_, moved_;
  Eigen::LDLT<MatrixXd> factor_;
  double chi2_ = 0, count_ = 0;
};

// A part of what is there is no other effect. One on the same joints again is
// no other one; on another stretch of poses it is.
bool IsIn(const PoseModel& model, const PlacedPoseEffect& placed) {
  const auto is_same = [&](const PlacedPoseEffect& has) {
    if (has.effect->part_of == placed.effect->name) return true;
    if (placed.effect->part_of == has.effect->name) return true;
    return has.effect == placed.effect &&
           has.place.joint == placed.place.joint &&
           has.place.by == placed.place.by &&
           (placed.place.begin < 0 || (has.place.begin == placed.place.begin &&
                                       has.place.end == placed.place.end));
  };
  return std::any_of(model.effects.begin(), model.effects.end(), is_same);
}

}  // namespace

// Tries every effect at every place, refines where the best ones begin and end,
// and keeps few of each effect, lest one with many places hides the others.
std::vector<ScannedEffect> ScanEffects(const PoseStudy& study,
                                       const PoseModel& model,
                                       bool equal_weights) {
  const EffectScan scan(study, model, equal_weights);
  std::vector<ScannedEffect> found;
  const auto better = [](const ScannedEffect& a, const ScannedEffect& b) {
    return a.score < b.score;
  };
  for (const PoseEffect& effect : PoseEffects()) {
    if (std::count(study.without.begin(), study.without.end(), effect.name)) {
      continue;
    }
    std::vector<ScannedEffect> own;
    for (const PosePlace& place : effect.places(model.campaign)) {
      if (IsIn(model, {&effect, place})) continue;
      own.push_back(scan.Try({&effect, place}));
    }
    std::sort(own.begin(), own.end(), better);
    std::vector<ScannedEffect> told;
    for (ScannedEffect& next : own) {
      if (told.size() == kPlacesEach) break;
      if (next.placed.place.begin >= 0) scan.Refine(&next);
      const bool again = std::any_of(
          told.begin(), told.end(),
          [&](const ScannedEffect& o) { return o.placed == next.placed; });
      if (!again && !IsIn(model, next.placed)) told.push_back(next);
    }
    found.insert(found.end(), told.begin(), told.end());
  }
  std::sort(found.begin(), found.end(), better);
  return found;
}

}  // namespace armcal
