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

PoseAmount LengthOf(const std::string& name,
                    const std::vector<PoseAmount>& components,
                    const MatrixXd& ci95) {
  VectorXd x(ci95.rows());
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = components[k].value;
  const VectorXd direction = x.stableNormalized();
  return {name,
          components[0].unit,
          x.norm(),
          std::sqrt(direction.dot(ci95 * direction)),
          {}};
}

// The covariance of the amounts is S^-1 (AmountsInformation) times the design
// effect and the variance factor of Student's t; its half-widths are t's
// quantile times roots. S is inverted by eigenvalues of its correlations: a
// direction that is not told becomes a wide interval, not an infinite one.
std::vector<PoseAmounts> AmountsOf(const PoseStudy& study,
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
  const MatrixXd half = quantile * std::sqrt(factor) * size.asDiagonal() *
                        eigen.eigenvectors() *
                        eigen.eigenvalues()
                            .cwiseMax(kNotTold)
                            .cwiseSqrt()
                            .cwiseInverse()
                            .asDiagonal();
  const MatrixXd ci95 = half * half.transpose();
  std::vector<PoseAmounts> all(model.effects.size());
  for (size_t e = 0; e < model.effects.size(); ++e) {
    const int begin = model.begin[e], count = model.begin[e + 1] - begin;
    all[e].ci95 = ci95.block(begin, begin, count, count);
    for (int k = begin; k < begin + count; ++k) {
      all[e].amounts.push_back({model.terms[k].name, model.terms[k].unit,
                                at.state.amounts[k], std::sqrt(ci95(k, k)),
                                model.terms[k].told});
    }
  }
  return all;
}

// A profile likelihood: the effect begins (ends) at each pose in turn, all else
// fitted anew, until -2 log p has risen by chi^2's quantile.
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
