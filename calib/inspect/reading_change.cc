#include "calib/inspect/reading_change.h"

#include <algorithm>

namespace armcal {

using Kind = ReadingChange::Kind;

namespace {

bool AreTheSame(const ReadingChange& a, const ReadingChange& b) {
  return a.kind == b.kind && a.joint == b.joint && a.other == b.other;
}

bool IsOfSigns(Kind kind) { return IsOneSign(kind) || IsAllSigns(kind); }

bool IsOfOneSignal(Kind kind) {
  return IsOneSign(kind) || kind == Kind::kPositionsExchanged ||
         kind == Kind::kTorquesExchanged;
}

}  // namespace

bool IsOneSign(Kind kind) {
  return kind == Kind::kPositionSign || kind == Kind::kTorqueSign;
}

bool IsAllSigns(Kind kind) {
  return kind == Kind::kAllTorqueSigns || kind == Kind::kAllPositionSigns;
}

bool MayBeEither(const ReadingChange& a, const ReadingChange& b) {
  if (IsAllSigns(a.kind) || IsAllSigns(b.kind)) {
    return a.kind != b.kind && IsOfSigns(a.kind) && IsOfSigns(b.kind);
  }
  if (!IsOfOneSignal(a.kind) || !IsOfOneSignal(b.kind) || AreTheSame(a, b))
    return false;
  const std::vector<int> joints = JointsOf(b);
  for (const int j : JointsOf(a)) {
    if (std::count(joints.begin(), joints.end(), j) > 0) return true;
  }
  return false;
}

std::vector<int> JointsOf(const ReadingChange& change) {
  std::vector<int> joints;
  for (const int j : {change.joint, change.other}) {
    if (j >= 0) joints.push_back(j);
  }
  return joints;
}

bool MoveAlike(const LogReading& a, const LogReading& b) {
  return a.wiring.position_column == b.wiring.position_column &&
         a.wiring.position_sign == b.wiring.position_sign &&
         a.units.degrees == b.units.degrees &&
         a.units.millimetres == b.units.millimetres && a.gravity == b.gravity;
}

}  // namespace armcal
