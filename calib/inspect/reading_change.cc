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

WiringSamples SamplesAs(const LogReading& reading, const Robot& robot,
                        const UniformSeries& series, int count) {
  WiringSamples samples =
      Rewired(series.Pick(count, reading.delay), reading.wiring);
  samples.tau *= reading.torque_unit;
  for (int j = 0; reading.units.any() && j < robot.num_joints(); ++j) {
    const double unit = reading.units.Of(robot.links[j].joint,
                                         reading.wiring.position_column[j]);
    samples.motion.q.col(j) *= unit;
    samples.motion.qd.col(j) *= unit;
    samples.motion.qdd.col(j) *= unit;
  }
  return samples;
}

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

void MergeTorqueSigns(std::vector<ReadingChange>* changes) {
  const auto all = std::find_if(
      changes->begin(), changes->end(),
      [](const ReadingChange& c) { return c.kind == Kind::kAllTorqueSigns; });
  if (all == changes->end()) return;
  ReadingChange merged = *all;
  std::vector<ReadingChange> others;
  for (const ReadingChange& change : *changes) {
    if (change.kind != Kind::kTorqueSign) {
      if (change.kind != Kind::kAllTorqueSigns) others.push_back(change);
      continue;
    }
    merged.but.push_back(change.joint);
    merged.gain += change.gain;
    merged.held_out_before =
        std::max(merged.held_out_before, change.held_out_before);
    merged.held_out_after =
        std::min(merged.held_out_after, change.held_out_after);
    merged.probability = std::min(merged.probability, change.probability);
    merged.alternatives.clear();  // they were of single steps
  }
  if (merged.but.empty()) return;
  std::sort(merged.but.begin(), merged.but.end());
  others.insert(others.begin(), merged);
  *changes = others;
}

void DropTorqueUnit(std::vector<ReadingChange>* changes) {
  changes->erase(std::remove_if(changes->begin(), changes->end(),
                                [](const ReadingChange& c) {
                                  return c.kind == Kind::kTorqueUnit;
                                }),
                 changes->end());
}

bool MoveAlike(const LogReading& a, const LogReading& b) {
  return a.wiring.position_column == b.wiring.position_column &&
         a.wiring.position_sign == b.wiring.position_sign &&
         a.units.degrees == b.units.degrees &&
         a.units.column == b.units.column &&
         a.units.millimetres == b.units.millimetres && a.gravity == b.gravity;
}

}  // namespace armcal
