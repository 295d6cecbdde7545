#include "calib/poses/diagnosis/interval.h"

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWithin = .95;
// chi^2 of one degree of freedom at 95 %.
constexpr double kChi2Within = 3.84;
// Poses that a range is followed to each side.
constexpr int kFarthest = 20;
// Of an amount's information beside its columns' own: not told.
constexpr double kNotTold = 1e-9;

}  // namespace

std::vector<std::vector<PoseAmount>> AmountsOf(const PoseStudy& study,
                                               const PoseModel& model,
                                               double design_effect) {
  if (model.terms.empty()) return {};
  const PoseEstimate& at = model.estimate;
  const double equations = static_cast<double>(at.linear.r.size());
  const double unknowns =
      at.parameters + static_cast<double>(model.terms.size());
  const double factor =
      design_effect * StudentVarianceFactor(at.linear.r,
                                            study.equations.width(), at.nu,
                                            at.errors, unknowns);
  const boost::math::students_t t(
      std::max(1.0, (equations - unknowns) / design_effect));
  const double quantile = boost::math::quantile(t, (1 + kWithin) / 2);
  const MatrixXd S = AmountsInformation(study, model);
  const VectorXd size =
      S.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(size.asDiagonal() * S *
                                                      size.asDiagonal());
  std::vector<std::vector<PoseAmount>> amounts(model.effects.size());
  for (size_t e = 0; e < model.effects.size(); ++e) {
    for (int k = model.begin[e]; k < model.begin[e + 1]; ++k) {
      double variance = 0;
      for (Eigen::Index d = 0; d < S.cols(); ++d) {
        const double v = eigen.eigenvectors()(k, d);
        variance += v * v / std::max(eigen.eigenvalues()[d], kNotTold);
      }
      amounts[e].push_back({model.terms[k].name, model.terms[k].unit,
                            at.state.amounts[k],
                            quantile * std::sqrt(factor * variance) * size[k]});
    }
  }
  return amounts;
}

PoseRange SideOf(const PoseStudy& study, const PoseModel& model, size_t effect,
                 int PosePlace::*side, double design_effect) {
  const int at = model.effects[effect].place.*side;
  if (at < 0) return {};
  PoseRange range = {at, at};
  const double best = model.estimate.Cost();
  for (const int direction : {-1, 1}) {
    for (int step = 1; step <= kFarthest; ++step) {
      std::vector<PlacedPoseEffect> effects = model.effects;
      PosePlace& place = effects[effect].place;
      place.*side = at + direction * step;
      const int end = place.end < 0 ? study.equations.poses() : place.end;
      if (place.begin < 1 || end > study.equations.poses() ||
          end - place.begin < 1) {
        break;
      }
      const PoseModel moved = FitPoseModel(study, effects, model, VectorXd());
      const double worse = moved.estimate.Cost() - best;
      if (worse / design_effect > kChi2Within) break;
      (direction < 0 ? range.first : range.last) = place.*side;
    }
  }
  return range;
}

}  // namespace armcal
