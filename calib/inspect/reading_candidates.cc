#include "calib/inspect/reading_candidates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armcal {

using Eigen::Vector3d;
using Kind = ReadingChange::Kind;

namespace {

LogReading Exchanged(LogReading reading, Kind kind, int j, int k) {
  Wiring& wiring = reading.wiring;
  if (kind != Kind::kTorquesExchanged)
    std::swap(wiring.position_column[j], wiring.position_column[k]);
  if (kind != Kind::kPositionsExchanged)
    std::swap(wiring.torque_column[j], wiring.torque_column[k]);
  return reading;
}

LogReading TurnedRound(LogReading reading, Kind kind, int j) {
  Wiring& wiring = reading.wiring;
  if (kind != Kind::kTorqueSign) wiring.position_sign[j] *= -1;
  if (kind != Kind::kPositionSign) wiring.torque_sign[j] *= -1;
  return reading;
}

LogReading AllTurnedRound(LogReading reading, Kind kind) {
  Wiring& wiring = reading.wiring;
  (kind == Kind::kAllTorqueSigns ? wiring.torque_sign : wiring.position_sign) *=
      -1;
  return reading;
}

}  // namespace

std::vector<Candidate> WiringCandidates(const LogReading& from,
                                        const std::vector<bool>& asked) {
  std::vector<Candidate> of_torques, of_positions;
  const auto n = static_cast<int>(asked.size());
  const auto add = [&](std::vector<Candidate>* all, Kind kind, int j, int k) {
    all->push_back({Exchanged(from, kind, j, k), {kind, j, k}});
  };
  const auto turn = [&](std::vector<Candidate>* all, Kind kind, int j) {
    all->push_back({TurnedRound(from, kind, j), {kind, j}});
  };
  for (int j = 0; j < n; ++j) {
    if (!asked[j]) continue;
    for (int k = j + 1; k < n; ++k) {
      if (!asked[k]) continue;
      add(&of_torques, Kind::kTorquesExchanged, j, k);
      add(&of_positions, Kind::kPositionsExchanged, j, k);
      add(&of_positions, Kind::kExchanged, j, k);
    }
    turn(&of_torques, Kind::kTorqueSign, j);
    turn(&of_positions, Kind::kPositionSign, j);
    turn(&of_positions, Kind::kJointSign, j);
  }
  // Of an arm of one joint they are its own.
  if (n > 1 && std::count(asked.begin(), asked.end(), true) > 0) {
    for (const Kind kind : {Kind::kAllTorqueSigns, Kind::kAllPositionSigns}) {
      auto& all = kind == Kind::kAllTorqueSigns ? of_torques : of_positions;
      all.push_back({AllTurnedRound(from, kind), {kind}});
    }
  }
  of_torques.insert(of_torques.end(), of_positions.begin(), of_positions.end());
  return of_torques;
}

Candidate InOtherUnit(const LogReading& from, Kind kind) {
  Candidate other{from, {kind}};
  PositionUnits& units = other.reading.units;
  (kind == Kind::kDegrees ? units.degrees : units.millimetres) ^= true;
  units.column = -1;
  return other;
}

std::vector<Candidate> OneInOtherUnit(const LogReading& from, Kind kind,
                                      const Robot& robot,
                                      const std::vector<bool>& asked) {
  std::vector<Candidate> all;
  const auto n = static_cast<int>(asked.size());
  // One that moves alone is all of them; beside a unit of all there is none.
  if (n < 2 || from.units.any()) return all;
  for (int j = 0; j < n; ++j) {
    const bool turns = IsRotational(robot.links[j].joint.type);
    if (!asked[j] || turns != (kind == Kind::kDegrees)) continue;
    all.push_back(InOtherUnit(from, kind));
    all.back().reading.units.column = from.wiring.position_column[j];
    all.back().change.joint = j;
  }
  return all;
}

std::vector<Candidate> UnitCandidates(const LogReading& from,
                                      const Robot& robot,
                                      const std::vector<bool>& asked) {
  bool turns = false, slides = false;
  for (const Link& link : robot.links) {
    (IsRotational(link.joint.type) ? turns : slides) = true;
  }
  std::vector<Candidate> all;
  if (turns) all.push_back(InOtherUnit(from, Kind::kDegrees));
  if (slides) all.push_back(InOtherUnit(from, Kind::kMillimetres));
  for (const Kind kind : {Kind::kDegrees, Kind::kMillimetres}) {
    for (Candidate& one : OneInOtherUnit(from, kind, robot, asked)) {
      all.push_back(std::move(one));
    }
  }
  return all;
}

void AddTorqueUnit(const LogReading& from, const TorqueScales& as_logged,
                   const std::vector<bool>& asked,
                   std::vector<Candidate>* candidates) {
  const double size = as_logged.Size();
  const bool is_other = size > kNotInertia || size < 1 / kNotInertia;
  const double unit =
      is_other && std::isfinite(size) && size > 0 ? 1 / size : 1;
  const double ratio = unit / from.torque_unit;
  if (ratio < kNotInertia && ratio > 1 / kNotInertia) return;
  Candidate other{from, {Kind::kTorqueUnit}};
  other.reading.torque_unit = unit;
  candidates->push_back(other);
  for (Candidate& both : WiringCandidates(other.reading, asked)) {
    candidates->push_back(std::move(both));
  }
}

double MisfitAsLogged(const TorqueFit& fit, const LogReading& reading,
                      const Eigen::MatrixXd& tau, double* percent) {
  const double misfit = fit.Misfit(tau, percent);
  if (reading.torque_unit == 1) return misfit;
  const double count =
      fit.InMotion(Eigen::MatrixXd::Ones(tau.rows(), tau.cols())).sum();
  return misfit - count * std::log(reading.torque_unit);
}

LogReading WithTurnedGravity(LogReading reading) {
  reading.gravity = Vector3d::Zero() - reading.gravity;  // without minus zeros
  return reading;
}

void AddTurnedGravity(std::vector<Candidate>* candidates) {
  const auto all = std::find_if(
      candidates->begin(), candidates->end(), [](const Candidate& candidate) {
        return candidate.change.kind == Kind::kAllTorqueSigns;
      });
  if (all == candidates->end()) return;
  const Candidate turned{WithTurnedGravity(all->reading), all->change};
  candidates->insert(all + 1, turned);
}

std::vector<Candidate> GravityCandidates(const LogReading& from,
                                         double magnitude) {
  std::vector<Candidate> all = {{from, {Kind::kGravity}}};
  all[0].reading.gravity.setZero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1., 1.}) {
      all.push_back(all[0]);
      all.back().reading.gravity[axis] = sign * magnitude;
    }
  }
  return all;
}

}  // namespace armcal
