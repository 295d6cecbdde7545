#include "calib/inspect/reading_candidates.h"

#include <utility>

namespace armcal {

using Eigen::Vector3d;
using Kind = ReadingChange::Kind;

std::vector<Candidate> WiringCandidates(const LogReading& from,
                                        const std::vector<bool>& moves) {
  std::vector<Candidate> all;
  const auto n = static_cast<int>(from.wiring.column.size());
  for (int j = 0; j < n; ++j) {
    if (!moves[from.wiring.column[j]]) continue;
    for (int k = j + 1; k < n; ++k) {
      if (!moves[from.wiring.column[k]]) continue;
      all.push_back({from, {Kind::kExchanged, j, k}});
      std::vector<int>& column = all.back().reading.wiring.column;
      std::swap(column[j], column[k]);
    }
    for (const Kind kind :
         {Kind::kPositionSign, Kind::kTorqueSign, Kind::kJointSign}) {
      all.push_back({from, {kind, j}});
      Wiring& wiring = all.back().reading.wiring;
      if (kind != Kind::kTorqueSign) wiring.position_sign[j] *= -1;
      if (kind != Kind::kPositionSign) wiring.torque_sign[j] *= -1;
    }
  }
  return all;
}

std::vector<Candidate> GravityCandidates(const LogReading& from,
                                         double magnitude) {
  std::vector<Candidate> all = {{from, {Kind::kGravity}}};
  all[0].reading.gravity.setZero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1., 1.}) {
      all.push_back({from, {Kind::kGravity}});
      all.back().reading.gravity = sign * magnitude * Vector3d::Unit(axis);
    }
  }
  return all;
}

}  // namespace armcal
