#include "calib/poses/touch_scale.h"

#include "calib/numerics/median.h"
#include "calib/poses/identifiability.h"

namespace armcal {

using Eigen::VectorXd;

namespace {

// By how much what is left may grow beside the factor itself.
constexpr double kStays = 1.01;

PoseUnknowns Scaled(const PoseFit& fit, const PoseMeasurements& measured,
                    PoseUnknowns unknowns, double factor) {
  const std::vector<std::string> units = fit.geometry().Units();
  for (int k = 0; k < fit.geometry().size(); ++k) {
    if (units[k] == "m") unknowns.geometry[k] *= factor;
  }
  for (Eigen::Index k = 0; k < unknowns.other.size(); ++k) {
    // Of a plane's three numbers only the last is a length.
    if (!measured.planes || k % 3 == 2) unknowns.other[k] *= factor;
  }
  return unknowns;
}

}  // namespace

// The factor f that minimises sum (f l - l_file)^2 over the lengths l is sum l
// l_file / sum l^2.
void SetScaleByFile(const PoseFit& fit, const PoseMeasurements& measured,
                    const std::vector<bool>& free, PoseUnknowns* unknowns) {
  const VectorXd file = fit.geometry().Values();
  const std::vector<std::string> units = fit.geometry().Units();
  const int held = ScaleLength(fit, fit.Wanted(RefineGeometry::kAll));
  double product = 0, square = 0;
  for (int k = 0; k < fit.geometry().size(); ++k) {
    if (units[k] != "m" || fit.PriorOf(k) == 0) continue;
    if (!free[k] && k != held) continue;
    product += unknowns->geometry[k] * file[k];
    square += unknowns->geometry[k] * unknowns->geometry[k];
  }
  if (!(product > 0)) return;
  const double factor = product / square;
  const std::vector<int> rows = fit.AllRows();
  const PoseUnknowns scaled = Scaled(fit, measured, *unknowns, factor);
  const double before = Rms(fit.Distances(rows, *unknowns));
  const double after = Rms(fit.Distances(rows, scaled));
  if (after <= kStays * std::max(1.0, factor) * before) *unknowns = scaled;
}

}  // namespace armcal
