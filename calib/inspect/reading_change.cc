#include "calib/inspect/reading_change.h"

namespace armcal {

using Kind = ReadingChange::Kind;

namespace {

bool IsOneOrder(Kind kind) {
  return kind == Kind::kPositionsExchanged || kind == Kind::kTorquesExchanged;
}

}  // namespace

bool IsOneSign(Kind kind) {
  return kind == Kind::kPositionSign || kind == Kind::kTorqueSign;
}

bool AreOfEitherSignal(const ReadingChange& a, const ReadingChange& b) {
  return a.kind != b.kind && a.joint == b.joint && a.other == b.other &&
         ((IsOneSign(a.kind) && IsOneSign(b.kind)) ||
          (IsOneOrder(a.kind) && IsOneOrder(b.kind)));
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
