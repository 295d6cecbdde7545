#include "calib/inspect/velocity_signs.h"

#include "calib/logs/channel_audit.h"

namespace armcal {
namespace {

using Kind = ReadingChange::Kind;

// The other sign of the same joint among what would do as well; null: none.
ReadingChange* PositionSignOf(ReadingChange* change) {
  for (ReadingChange& other : change->alternatives) {
    if (other.kind == Kind::kPositionSign && other.joint == change->joint) {
      return &other;
    }
  }
  return nullptr;
}

}  // namespace

std::vector<bool> OppositeVelocities(const Log& log) {
  std::vector<bool> opposite;
  for (int j = 0; j < log.q.cols(); ++j) {
    const auto fit = FitVelocity(log, j);
    opposite.push_back(fit && fit->alike < -.8);
  }
  return opposite;
}

void BelieveVelocities(const std::vector<bool>& opposite,
                       ReadingFinding* finding) {
  Wiring& wiring = finding->reading.wiring;
  for (ReadingChange& change : finding->changes) {
    if (change.kind != Kind::kTorqueSign) continue;
    ReadingChange* position = PositionSignOf(&change);
    if (position == nullptr) continue;
    const int j = change.joint;
    if (!opposite[wiring.position_column[j]]) continue;
    change.kind = Kind::kPositionSign;
    position->kind = Kind::kTorqueSign;
    change.hint = "its recorded velocity says so, too";
    wiring.torque_sign[j] *= -1;
    wiring.position_sign[j] *= -1;
  }
}

}  // namespace armcal
