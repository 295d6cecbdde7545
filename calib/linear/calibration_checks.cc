#include "calib/linear/calibration_checks.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/used_equations.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {

// A cutoff must lie between the lowest frequency that a log can tell, 1 / its
// length, and the highest, half the sample rate (Nyquist), of the slowest log.
void CheckBandwidth(const std::optional<double>& given,
                    const LogSet& training) {
  if (!given || *given == 0) return;
  double longest = 0, slowest = 0;
  for (const TimeBase& base : training.time_bases()) {
    longest = std::max(longest, base.range.end - base.range.begin);
    slowest = std::max(slowest, base.dt);
  }
  if (*given >= 0.5 / slowest) {
    throw InputError("", OptionName("bandwidth"), NumberText(*given),
                     "expected 0, or less than half the sample rate, " +
                         NumberText(0.5 / slowest) + " Hz");
  }
  if (*given * longest >= 1) return;
  throw InputError("", OptionName("bandwidth"), NumberText(*given),
                   "expected 0, or a frequency in Hz whose period is shorter "
                   "than the log, " +
                       NumberText(longest) + " s");
}

void CheckIntervals(const RowOptions& rows, const LogSet& training,
                    long equations) {
  if (rows.identification != Identification::kIntegral) return;
  const long expected =
      static_cast<long>(rows.intervals.size()) * training.size();
  if (equations >= expected) return;
  throw InputError(
      training.path(0), OptionName("intervals"), "",
      std::to_string(expected - equations) + " of " + std::to_string(expected) +
          " intervals cannot be used; expected each to lie within the log, "
          "clear of gaps and standstill");
}

void CheckNoOverflow(const TorqueResidual& residual, const LogSet& held_out) {
  if (residual.moving().residual_rms.allFinite()) return;
  throw InputError(
      held_out.path(0), "", "",
      "the torque in the held-out logs overflows; expected torques "
      "in N m, forces in N");
}

std::string WhyNothingToSolve(const LogFactors& factors,
                              const ModelParameters& parameters) {
  const BlockTriangularFactor all = factors.Merged(
      parameters, AllEquations(factors, parameters.num_joints()).used);
  if (all.rows(0) == 0) {
    return "the logs hold no stretch of motion that is long enough for an "
           "equation";
  }
  const double torque = RightSideRms(all).maxCoeff();
  if (torque == 0) return "the torque in the logs is zero throughout";
  if (!std::isfinite(torque)) return "the torque in the logs overflows";
  return "";
}

}  // namespace armcal
