#include "calib/fleet/calibration.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/log_evidence.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

int UnitOf(const std::vector<std::string>& units, const ReducedLog& log) {
  const auto at = std::lower_bound(units.begin(), units.end(), log.unit);
  return static_cast<int>(at - units.begin());
}

Reduction OfUnit(const Reduction& all, const std::string& unit) {
  Reduction own{all.model, {}};
  for (const ReducedLog& log : all.logs) {
    if (log.unit == unit) own.logs.push_back(log);
  }
  return own;
}

// Each unit by itself; returns the degrees of freedom that a joint's noise has.
VectorXd CalibrateUnits(const Robot& robot, const Reduction& reduction,
                        const Progress& progress, FleetCalibration* fleet) {
  const auto units = static_cast<Eigen::Index>(fleet->units.size());
  VectorXd freedom = VectorXd::Zero(units);
  for (Eigen::Index u = 0; u < units; ++u) {
    if (progress) {
      progress("units alone",
               static_cast<double>(u) / static_cast<double>(units));
    }
    const Reduction logs = OfUnit(reduction, fleet->units[u]);
    const LinearCalibration own = CalibrateFromFactors(robot, logs);
    fleet->logs.push_back(static_cast<int>(logs.logs.size()));
    fleet->equations.push_back(own.equations);
    fleet->own.row(u) = own.x.transpose();
    fleet->own_stddev.row(u) = own.stddev.transpose();
    if (!own.solved) continue;
    fleet->noise.row(u) = own.noise.transpose();
    freedom[u] = NoiseFreedom(own, Inflations(logs).mean());
  }
  return freedom;
}

}  // namespace

std::vector<std::string> UnitNames(const Reduction& reduction) {
  std::set<std::string> names;
  for (const ReducedLog& log : reduction.logs) {
    if (!log.unit.empty()) names.insert(log.unit);
  }
  return {names.begin(), names.end()};
}

FleetCalibration CalibrateFleet(const Robot& robot, const Reduction& reduction,
                                const LinearCalibration& pooled,
                                const FleetOptions& options,
                                const Progress& progress) {
  FleetCalibration fleet;
  fleet.units = UnitNames(reduction);
  const auto units = static_cast<Eigen::Index>(fleet.units.size());
  const int m = pooled.parameters.size();
  fleet.own = fleet.own_stddev = MatrixXd::Zero(units, m);
  fleet.noise = MatrixXd::Zero(units, robot.num_joints());
  ShrinkNoise(CalibrateUnits(robot, reduction, progress, &fleet), &fleet.noise);
  const VectorXd inflations = Inflations(reduction);
  std::vector<UnitEvidence> evidence;
  bool dated = true;
  for (size_t k = 0; k < reduction.logs.size(); ++k) {
    const ReducedLog& log = reduction.logs[k];
    if (log.unit.empty()) continue;
    const int unit = UnitOf(fleet.units, log);
    evidence.push_back(EvidenceOf(FactorOf(pooled.parameters, log),
                                  pooled.used[k], fleet.noise.row(unit),
                                  inflations[static_cast<Eigen::Index>(k)]));
    evidence.back().unit = unit;
    evidence.back().time = log.time.value_or(0);
    dated = dated && log.time.has_value();
  }
  if (progress) progress("units together", -1);
  FleetOptions fitted = options;
  fitted.drift = options.drift && dated;
  if (!dated) {
    for (UnitEvidence& e : evidence) e.time = 0;
  }
  fleet.fit = FitFleet(evidence, static_cast<int>(units), fitted);
  return fleet;
}

}  // namespace armcal
