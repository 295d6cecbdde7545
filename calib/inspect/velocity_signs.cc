#include "calib/inspect/velocity_signs.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "calib/logs/channel_audit.h"

namespace armcal {
namespace {

using Kind = ReadingChange::Kind;

// The other signal's sign of the same joint, or of all, among what would do as
// well; null: none.
ReadingChange* AmongAlternatives(Kind kind, ReadingChange* change) {
  for (ReadingChange& other : change->alternatives) {
    if (other.kind == kind && other.joint == change->joint) return &other;
  }
  return nullptr;
}

// Takes the positions for the torques, or the other way round, of joint j.
void TurnBoth(int j, Wiring* wiring) {
  wiring->torque_sign[j] *= -1;
  wiring->position_sign[j] *= -1;
}

// Of most columns: what stands still tells nothing.
bool AreOpposite(const std::vector<bool>& opposite) {
  const auto count = std::count(opposite.begin(), opposite.end(), true);
  return 2 * count > static_cast<int64_t>(opposite.size());
}

// An arm that is its own mirror image fits alike with all positions turned and
// with all torques turned. Then it is the torques, unless velocities say that
// it is the positions: whether a torque is the drive's on the link or the
// link's on the drive, action or reaction, is one convention for all joints.
void ChooseOfAll(const std::vector<bool>& opposite, ReadingChange* change,
                 Wiring* wiring) {
  const bool positions = AreOpposite(opposite);
  const Kind right =
      positions ? Kind::kAllPositionSigns : Kind::kAllTorqueSigns;
  if (change->kind == right) return;
  ReadingChange* other = AmongAlternatives(right, change);
  if (other == nullptr) return;
  std::swap(change->kind, other->kind);
  if (positions) change->hint = "recorded velocities say so, too";
  for (Eigen::Index j = 0; j < wiring->torque_sign.size(); ++j) {
    TurnBoth(static_cast<int>(j), wiring);
  }
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
    if (IsAllSigns(change.kind)) ChooseOfAll(opposite, &change, &wiring);
    if (change.kind != Kind::kTorqueSign) continue;
    ReadingChange* position = AmongAlternatives(Kind::kPositionSign, &change);
    if (position == nullptr) continue;
    const int j = change.joint;
    if (!opposite[wiring.position_column[j]]) continue;
    std::swap(change.kind, position->kind);
    change.hint = "its recorded velocity says so, too";
    TurnBoth(j, &wiring);
  }
}

}  // namespace armcal
