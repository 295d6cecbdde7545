#include "model/robot/saturating_parts.h"

#include <Eigen/QR>
#include <algorithm>

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTanhTolerance = .01;
constexpr double kTanhEnd = 6;  // where tanh is 1 to 1e-5
constexpr int kTanhSamples = 200;

double SlopeBetween(const Knot& a, const Knot& b) {
  return (b.force - a.force) / (b.x - a.x);
}

// What each knot's value adds to the line at x: 1 at itself, 0 at the others
// and even between.
MatrixXd HatFunctions(const std::vector<Knot>& knots, const ArrayXd& x) {
  MatrixXd hats = MatrixXd::Zero(x.size(), knots.size());
  size_t next = 1;
  for (Index i = 0; i < x.size(); ++i) {
    while (next + 1 < knots.size() && x[i] > knots[next].x) ++next;
    const double begin = knots[next - 1].x;
    const double along = (x[i] - begin) / (knots[next].x - begin);
    hats(i, next - 1) = 1 - along;
    hats(i, next) = along;
  }
  return hats;
}

VectorXd Values(const std::vector<Knot>& knots) {
  VectorXd values(knots.size());
  for (size_t k = 0; k < knots.size(); ++k) values[k] = knots[k].force;
  return values;
}

void FitValues(const ArrayXd& x, const ArrayXd& f, std::vector<Knot>* knots) {
  const Index inner = static_cast<Index>(knots->size()) - 2;
  if (inner < 1) return;
  const MatrixXd hats = HatFunctions(*knots, x);
  const VectorXd left = f.matrix() - hats.rightCols(1) * knots->back().force;
  const VectorXd values =
      hats.middleCols(1, inner).colPivHouseholderQr().solve(left);
  for (Index k = 0; k < inner; ++k) (*knots)[k + 1].force = values[k];
}

}  // namespace

std::vector<Knot> FitKnots(const ArrayXd& x, const ArrayXd& f,
                           double tolerance) {
  const double most = tolerance * f.abs().maxCoeff();
  std::vector<Knot> knots = {{0, 0}, {x[x.size() - 1], f[f.size() - 1]}};
  while (true) {
    const ArrayXd line = HatFunctions(knots, x) * Values(knots);
    Index worst;
    if (!((line - f).abs().maxCoeff(&worst) > most)) break;
    const auto behind =
        std::find_if(knots.begin(), knots.end(),
                     [&](const Knot& knot) { return knot.x >= x[worst]; });
    knots.insert(behind, {x[worst], f[worst]});
  }
  FitValues(x, f, &knots);
  return knots;
}

std::vector<Knot> ConcaveHull(const std::vector<Knot>& knots) {
  std::vector<Knot> hull;
  for (const Knot& next : knots) {
    while (hull.size() > 1 &&
           SlopeBetween(hull[hull.size() - 2], hull.back()) <=
               SlopeBetween(hull.back(), next)) {
      hull.pop_back();
    }
    hull.push_back(next);
  }
  return hull;
}

std::vector<SaturatingPart> PartsOf(const std::vector<Knot>& knots) {
  std::vector<SaturatingPart> parts;
  for (size_t k = 1; k < knots.size(); ++k) {
    const double behind =
        k + 1 < knots.size() ? SlopeBetween(knots[k], knots[k + 1]) : 0;
    const double bend = SlopeBetween(knots[k - 1], knots[k]) - behind;
    if (bend != 0) parts.push_back({knots[k].x * bend, knots[k].x});
  }
  return parts;
}

BoundedSpring TanhSpring(double force, double centre, double softness) {
  const ArrayXd x =
      ArrayXd::LinSpaced(kTanhSamples, kTanhEnd / kTanhSamples, kTanhEnd);
  BoundedSpring spring{centre, PartsOf(FitKnots(x, x.tanh(), kTanhTolerance))};
  for (SaturatingPart& part : spring.parts) {
    part.force *= force;
    part.width *= softness;
  }
  return spring;
}

}  // namespace armcal
