#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/pulses.h"
#include "calib/diagnose/select/regression.h"
#include "calib/numerics/maxima.h"

namespace armcal {

// What the peaks of a log's own pulses say, where there is no event.
struct OwnPulses {
  // How probable it is that there is one as large as each event's by itself.
  std::vector<double> chances;
  // Per joint: what deviations are off by, over what the model knows of it; 1
  // where it is less.
  Eigen::VectorXd scale;
};

// Pulses of torque in logs (PulseScan), and how probable they are without a
// contact: as the pulses of a reference are, which nothing touched, and those
// of the logs themselves.
class PulseSearch {
 public:
  // Given the baseline, fitted as `regression` has it, and `effects`; of the
  // samples of `data` that are not masked. `regression` has a reference.
  PulseSearch(const GapRegression& regression,
              const std::vector<GapCandidate>& effects, const GapData& data);

  // Those less probable than false_contacts.
  std::vector<GapEvent> Find() const;
  // The largest in each event's window, with its chance: 1 where none is seen.
  std::vector<GapEvent> LargestIn(const std::vector<GapEvent>& events) const;
  // What the logs say beside these events' windows.
  OwnPulses BesideEvents(const std::vector<GapEvent>& events) const;

 private:
  OwnPulses Beside(const std::vector<std::vector<int>>& windows) const;
  std::vector<double> ChancesIn(
      const Eigen::VectorXd& series, const std::vector<bool>& in_window,
      const std::vector<std::vector<int>>& windows) const;
  double Chance(double deviations, double in_log) const;
  GapEvent LeastProbable(const std::vector<std::vector<int>>& found) const;

  const GapRows& rows_;
  Robot robot_;
  std::optional<PulseScan> scan_;
  Eigen::MatrixXd squares_;  // of the scan's deviations
  UsualMaximum usual_;       // square, of a reference
};

}  // namespace armcal
