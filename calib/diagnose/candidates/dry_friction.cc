#include "calib/diagnose/candidates/dry_friction.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "model/robot/saturating_parts.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;

constexpr int kCurveSamples = 400;       // of the curve, evenly over log v
constexpr double kCurveBegin = .125;     // of the narrowest part's width, to
constexpr double kCurveEnd = 3;          // times the widest, where tanh is .995
constexpr double kCurveTolerance = .02;  // of the curve's largest value
constexpr double kLeastBump = .02;       // of its end value: less does not fall

// Friction over velocity: parts of a fit and Stribeck's.
struct DryCurve {
  std::vector<SaturatingPart> parts;  // as force tanh(v / width)
  std::vector<BristleFriction> stribeck;
  double narrowest = 0, widest = 0;  // of the parts
  double width = 0;                  // of Stribeck's

  double end() const {
    double sum = 0;
    for (const SaturatingPart& part : parts) sum += part.force;
    return sum;
  }
  double operator()(double v) const {
    double sum = 0;
    for (const SaturatingPart& part : parts) {
      sum += part.force * std::tanh(v / part.width);
    }
    for (const BristleFriction& law : stribeck) {
      const double x = v / law.stribeck_velocity;
      sum += law.at_rest * std::exp(-x * x) * std::tanh(v / width);
    }
    return sum;
  }
};

// It ends where all of it has saturated.
std::vector<SaturatingPart> Saturating(const DryCurve& curve) {
  double last = kCurveEnd * curve.widest;
  for (const BristleFriction& law : curve.stribeck) {
    last = std::max(last, kCurveEnd * law.stribeck_velocity);
  }
  const ArrayXd v =
      ArrayXd::LinSpaced(kCurveSamples, std::log(kCurveBegin * curve.narrowest),
                         std::log(last))
          .exp();
  ArrayXd f = v.unaryExpr([&](double at) { return curve(at); });
  f[kCurveSamples - 1] = curve.end();
  const bool falls = f.maxCoeff() > (1 + kLeastBump) * curve.end();
  if (!falls) f = f.cwiseMax(0).cwiseMin(curve.end());
  std::vector<Knot> knots = FitKnots(v, f, kCurveTolerance);
  if (falls) return PartsOf(knots);
  for (Knot& knot : knots) knot.force = std::min(knot.force, curve.end());
  return PartsOf(ConcaveHull(knots));
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
  drive->dry = Saturating(curve);
  return curve.end();
}

}  // namespace armcal
