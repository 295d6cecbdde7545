#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/contacts/pulses.h"
#include "calib/diagnose/select/events.h"
#include "calib/diagnose/select/regression.h"
#include "calib/numerics/maxima.h"

namespace armcal {

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
  // A pulse again, with the time and the width that fit it best.
  Contact Fitted(const Contact& found) const;
  // What the logs say beside these events' windows.
  OwnPulses BesideEvents(const std::vector<GapEvent>& events) const;

 private:
  struct Bank {
    std::vector<double> widths;  // s
    PulseResponses responses;
    Eigen::MatrixXd squares;          // of their deviations
    std::vector<UsualMaximum> usual;  // square, of a reference, per joint
  };
  using Windows = std::vector<std::vector<int>>;  // thinned samples of each

  GapEvent EventAt(const Bank& bank, int sample, int joint) const;
  double Chance(const Bank& bank, int joint, double square,
                double in_log) const;
  std::optional<GapEvent> BetterFit(const Contact& found, double reach,
                                    double longest) const;
  GapEvent AsLongAsItIs(const GapEvent& event) const;
  GapEvent LeastProbable(const Bank& bank, const Windows& found) const;
  GapEvent LargestOf(const Bank& bank, const std::vector<int>& window,
                     double in_log) const;

  const GapRows& rows_;
  Robot robot_;
  std::optional<PulseScan> scan_;
  std::vector<Bank> banks_;
};

}  // namespace armcal
