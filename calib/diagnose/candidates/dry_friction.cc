#include "calib/diagnose/candidates/dry_friction.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::ArrayXd;

constexpr int kKnotCount = 8;        // from half the narrowest part's width ..
constexpr double kFirstKnot = .5;    // .. to twice the widest one's
constexpr double kLastKnot = 2;      // where tanh is .96 of its end
constexpr int kCurveSamples = 160;   // of the curve that a bump is fitted to
constexpr double kLeastBump = .02;   // of the end value, and
constexpr double kLeastPart = 1e-3;  // of it: less is left out

// Friction over velocity: parts of a fit and Stribeck's.
struct DryCurve {
  std::vector<SaturatingFriction> parts;  // as force tanh(v / width)
  std::vector<BristleFriction> stribeck;
  double narrowest = 0, widest = 0;  // of the parts
  double width = 0;                  // of Stribeck's

  double end() const {
    double sum = 0;
    for (const SaturatingFriction& part : parts) sum += part.force;
    return sum;
  }
  double operator()(double v) const {
    double sum = 0;
    for (const SaturatingFriction& part : parts) {
      sum += part.force * std::tanh(v / part.width);
    }
    for (const BristleFriction& law : stribeck) {
      const double x = v / law.stribeck_velocity;
      sum += law.at_rest * std::exp(-x * x) * std::tanh(v / width);
    }
    return sum;
  }
};

ArrayXd Geometric(double low, double high, int count) {
  return ArrayXd::LinSpaced(count, std::log(low), std::log(high)).exp();
}

// s exp(-(v/w)^2) by least squares beyond the curve's peak; none where it does
// not exceed its end value by much.
std::vector<BristleFriction> FitBump(const DryCurve& curve) {
  double last = curve.widest;
  for (const BristleFriction& law : curve.stribeck) {
    last = std::max(last, law.stribeck_velocity);
  }
  const ArrayXd all = Geometric(curve.narrowest / 4, 6 * last, kCurveSamples);
  const ArrayXd f = all.unaryExpr([&](double v) { return curve(v); });
  Eigen::Index peak;
  const double highest = f.maxCoeff(&peak);
  if (highest <= (1 + kLeastBump) * curve.end()) return {};
  const Eigen::Index count = all.size() - peak;
  const ArrayXd v = all.tail(count), excess = f.tail(count) - curve.end();
  BristleFriction best;
  double least = excess.square().sum();
  for (const double w : Geometric(v[0] / 2, 6 * last, kCurveSamples)) {
    const ArrayXd bump = (-(v / w).square()).exp();
    const double s = (bump * excess).sum() / bump.square().sum();
    const double left = (excess - s * bump).square().sum();
    if (s <= 0 || left >= least) continue;
    least = left;
    best = BristleFriction::Stribeck(s, w, curve.narrowest);
  }
  if (best.at_rest == 0) return {};
  return {best};
}

struct Knot {
  double v, force;
};

double SlopeBetween(const Knot& a, const Knot& b) {
  return (b.force - a.force) / (b.v - a.v);
}

// The upper hull of (0, 0) and the curve without its bump at the knots, between
// 0 and its end value, which the last of them has.
std::vector<Knot> Hull(const DryCurve& curve,
                       const std::vector<BristleFriction>& bumps) {
  const ArrayXd knots = Geometric(kFirstKnot * curve.narrowest,
                                  kLastKnot * curve.widest, kKnotCount);
  std::vector<Knot> hull = {{0, 0}};
  for (const double v : knots) {
    double force = curve(v);
    for (const BristleFriction& bump : bumps) {
      const double x = v / bump.stribeck_velocity;
      force -= bump.at_rest * std::exp(-x * x);
    }
    force = std::clamp(force, 0., curve.end());
    if (v == knots[kKnotCount - 1]) force = curve.end();
    const Knot next = {v, force};
    while (hull.size() > 1 &&
           SlopeBetween(hull[hull.size() - 2], hull.back()) <=
               SlopeBetween(hull.back(), next)) {
      hull.pop_back();
    }
    hull.push_back(next);
  }
  return hull;
}

std::vector<SaturatingFriction> PartsOf(const std::vector<Knot>& hull) {
  std::vector<SaturatingFriction> parts;
  for (size_t k = 1; k < hull.size(); ++k) {
    const double behind =
        k + 1 < hull.size() ? SlopeBetween(hull[k], hull[k + 1]) : 0;
    const double force =
        hull[k].v * (SlopeBetween(hull[k - 1], hull[k]) - behind);
    if (force <= kLeastPart * hull.back().force) continue;
    parts.push_back({force, hull[k].v});
  }
  return parts;
}

// All that yields with displacement as one law of the same stiffness.
void AddYielding(const std::vector<CoulombPart>& coulomb, JointDrive* drive) {
  double force = 0, stiffness = 0;
  for (const CoulombPart& part : coulomb) {
    if (part.transition.law == CoulombTransition::Law::kVelocity) continue;
    force += part.force;
    stiffness += part.force / part.transition.width;
  }
  if (force <= 0 || stiffness <= 0) return;
  drive->bristles.push_back({stiffness, force, force});
}

}  // namespace

double SetDryFriction(const std::vector<CoulombPart>& coulomb, double width,
                      JointDrive* drive) {
  DryCurve curve;
  curve.width = width;
  for (const CoulombPart& part : coulomb) {
    const double its = part.transition.width;
    if (part.transition.law != CoulombTransition::Law::kVelocity) continue;
    if (part.force == 0) continue;
    const bool first = curve.parts.empty();
    curve.narrowest = first ? its : std::min(curve.narrowest, its);
    curve.widest = std::max(curve.widest, its);
    curve.parts.push_back({part.force, its});
  }
  AddYielding(coulomb, drive);
  if (curve.parts.empty() || curve.narrowest <= 0 || curve.end() <= 0) return 0;
  std::vector<BristleFriction>& bristles = drive->bristles;
  const auto rest =
      std::stable_partition(bristles.begin(), bristles.end(),
                            [](const auto& law) { return law.coulomb > 0; });
  curve.stribeck.assign(rest, bristles.end());
  bristles.erase(rest, bristles.end());
  const std::vector<BristleFriction> bumps = FitBump(curve);
  drive->dry = PartsOf(Hull(curve, bumps));
  bristles.insert(bristles.end(), bumps.begin(), bumps.end());
  return curve.end();
}

}  // namespace armcal
