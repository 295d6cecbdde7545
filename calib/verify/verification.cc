#include "calib/verify/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/numerics/undefined.h"
#include "calib/verify/arm_states.h"
#include "calib/verify/largest_ratio.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/plant/simbody_arm.h"
#include "model/signals/integration.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Two independent engines in double precision agree to 1e-16 times what their
// sums lose; more than kSame is a difference of models.
constexpr double kSame = 1e-10;
constexpr double kDrift = 1e-6;
// Solving with the mass matrix loses its condition number.
constexpr double kConsistent = 1e-8;
constexpr double kSwingAccuracy = 1e-9;  // local error of integrators
constexpr int kSwingParts = 10;          // where the energy is looked at
// Of a swing; arms of a metre take some 20,000 at most.
constexpr int kSwingSteps = 100'000;

// Why Simbody refuses links, each looked at alone.
std::vector<std::string> Refusals(const Robot& robot) {
  std::vector<std::string> refusals;
  for (const Link& link : robot.links) {
    Robot alone = robot;
    alone.links = {link};
    try {
      SimbodyArm arm(alone);
    } catch (const InputError& error) {
      refusals.push_back(error.what());
    }
  }
  return refusals;
}

double LargestTorque(const Robot& robot, const std::vector<ArmState>& states) {
  double largest = 0;
  for (const ArmState& s : states) {
    largest =
        std::max(largest, InverseDynamics(robot, s.q, s.qd, s.qdd).norm());
  }
  return largest;
}

// Compares tau = M qdd + c + g, M, g and the energies of both engines at the
// same states. The torque alone would do if states were rich; the parts say
// what is wrong.
void CompareWithSimbody(const Robot& robot, const std::vector<ArmState>& states,
                        const Progress& progress, SimbodyArm* arm,
                        Verification* result) {
  const double floor = kSmallTorque * LargestTorque(robot, states);
  LargestRatio torque, mass, gravity, energy;
  for (size_t k = 0; k < states.size(); ++k) {
    const ArmState& s = states[k];
    const VectorXd tau = arm->InverseDynamics(s.q, s.qd, s.qdd);
    torque.Add((InverseDynamics(robot, s.q, s.qd, s.qdd) - tau).norm(),
               std::max(floor, tau.norm()));
    const Eigen::MatrixXd M = arm->MassMatrix(s.q);
    mass.Add((MassMatrix(robot, s.q) - M).norm(), M.norm());
    const VectorXd g = arm->GravityTorque(s.q);
    gravity.Add((GravityTorque(robot, s.q) - g).norm(),
                std::max(floor, g.norm()));
    const ArmEnergy own = Energy(robot, s.q, s.qd);
    const double kinetic = arm->KineticEnergy(s.q, s.qd);
    const double potential = arm->PotentialEnergy(s.q);
    energy.Add(
        std::abs(own.kinetic - kinetic) + std::abs(own.potential - potential),
        std::abs(kinetic) + std::abs(potential));
    if (progress && k % 100 == 0) progress("states", 1.0 * k / states.size());
  }
  result->torque_max_rel = torque.value();
  result->mass_matrix_max_rel = mass.value();
  result->gravity_max_rel = gravity.value();
  result->energy_max_rel = energy.value();
}

// Whether forward dynamics invert inverse dynamics: |tau(qdd(tau)) - tau| /
// |tau|. Torques are compared and not accelerations, which a light wrist may
// have to only a few digits (Higham 2002, ch. 7: the residual is small though
// the error is not). Armature is left out, as it makes any mass matrix well
// conditioned.
double Inconsistency(const Robot& robot, const std::vector<ArmState>& states) {
  const double floor = kSmallTorque * LargestTorque(robot, states);
  Robot bare = robot;
  for (Link& link : bare.links) link.joint.armature = 0;
  LargestRatio worst;
  for (const ArmState& s : states) {
    const VectorXd tau = InverseDynamics(bare, s.q, s.qd, s.qdd);
    const VectorXd qdd = ForwardDynamics(bare, s.q, s.qd, tau);
    worst.Add((InverseDynamics(bare, s.q, s.qd, qdd) - tau).norm(),
              std::max(floor, tau.norm()));
  }
  return worst.value();
}

// Where a passive swing starts: within the joints' limits, moving.
ArmState SwingStart(const Robot& robot, std::uint64_t seed) {
  ArmState start = RandomStates(robot, 1, seed)[0];
  for (int j = 0; j < robot.num_joints(); ++j) {
    const bool turns = IsRotational(robot.links[j].joint.type);
    start.qd[j] = std::copysign(turns ? 1 : 0.1, start.qd[j]);
  }
  return start;
}

// The energy along a swing.
class Drift {
 public:
  explicit Drift(double start) : start_(start) {}
  void Add(double kinetic, double potential) {
    kinetic_ = std::max(kinetic_, kinetic);
    drift_ = std::max(drift_, std::abs(kinetic + potential - start_));
  }
  double relative() const { return drift_ / kinetic_; }

 private:
  double start_, drift_ = 0, kinetic_ = 0;
};

// The energy of a passive swing is constant. That tests forward dynamics,
// kinetic and potential energy against each other along a motion that nobody
// chose.
double SwingInSimbody(const ArmState& start, double duration,
                      const Progress& progress, SimbodyArm* arm) {
  VectorXd q = start.q, qd = start.qd;
  Drift drift(arm->KineticEnergy(q, qd) + arm->PotentialEnergy(q));
  for (int part = 0; part < kSwingParts; ++part) {
    if (!arm->Swing(duration / kSwingParts, kSwingAccuracy,
                    kSwingSteps / kSwingParts, &q, &qd)) {
      return kNaN;
    }
    drift.Add(arm->KineticEnergy(q, qd), arm->PotentialEnergy(q));
    if (progress) progress("swing", (part + 1.0) / kSwingParts);
  }
  return drift.relative();
}

// The same by our dynamics; *reason says why where it does not come to its end.
double Swing(const Robot& robot, const ArmState& start, double duration,
             std::string* reason) {
  const int n = robot.num_joints();
  Robot bare = robot;
  for (Link& link : bare.links) link.joint.armature = 0;
  VectorXd x0(2 * n);
  x0 << start.q, start.qd;
  std::vector<double> times;
  for (int k = 1; k <= kSwingParts; ++k) {
    times.push_back(duration * k / kSwingParts);
  }
  IntegrationOptions options;
  options.relative = options.absolute = kSwingAccuracy;
  options.max_steps = kSwingSteps;
  const Integration swing = Integrate(
      [&bare, n](double, const VectorXd& x, VectorXd* rate) {
        *rate << x.tail(n),
            ForwardDynamics(bare, x.head(n), x.tail(n), VectorXd::Zero(n));
      },
      x0, 0, times, options);
  if (!swing.finished) {
    *reason = robot.name +
              ": our dynamics cannot follow a passive swing: " + swing.reason;
    return kNaN;
  }
  Drift drift(Energy(bare, start.q, start.qd).total());
  for (const auto& row : swing.x.rowwise()) {
    const VectorXd x = row.transpose();
    const ArmEnergy energy = Energy(bare, x.head(n), x.tail(n));
    drift.Add(energy.kinetic, energy.potential);
  }
  return drift.relative();
}

// Takes the longest swing that both engines follow, else one that ours does:
// chaotic arms with light links need steps without end. `arm`: Simbody's; null
// where it refuses the robot.
void CompareSwings(const Robot& robot, const VerificationOptions& options,
                   SimbodyArm* arm, Verification* result) {
  const ArmState start = SwingStart(robot, options.seed);
  std::string reason;
  for (const double duration :
       {options.swing_s, options.swing_s / 10, options.swing_s / 100}) {
    std::string why;
    const double own = Swing(robot, start, duration, &why);
    if (std::isnan(own)) {
      reason = why;
      continue;
    }
    const double simbody =
        arm ? SwingInSimbody(start, duration, options.progress, arm) : kNaN;
    if (result->swing_s > 0 && std::isnan(simbody)) continue;
    result->own_energy_drift_rel = own;
    result->energy_drift_rel = simbody;
    result->swing_s = duration;
    if (!arm || !std::isnan(simbody)) return;
  }
  if (result->swing_s == 0) result->reasons.push_back(reason);
}

}  // namespace

std::vector<VerificationCheck> Verification::Checks() const {
  const bool own_swings = !std::isnan(own_energy_drift_rel);
  return {{"torque_max_rel", torque_max_rel, kSame},
          {"mass_matrix_max_rel", mass_matrix_max_rel, kSame},
          {"gravity_max_rel", gravity_max_rel, kSame},
          {"energy_max_rel", energy_max_rel, kSame},
          {"energy_drift_rel", energy_drift_rel, kDrift, own_swings},
          {"own_energy_drift_rel", own_energy_drift_rel, kDrift},
          {"own_consistency_rel", own_consistency_rel, kConsistent}};
}

bool Verification::passed() const {
  const auto checks = Checks();
  return reasons.empty() &&
         std::all_of(checks.begin(), checks.end(),
                     [](const VerificationCheck& c) { return c.passed(); });
}

// Random states reach what a log does not; a log's states have the ratios of
// gravity, speed and acceleration that the robot really sees.
Verification VerifyDynamics(const Robot& robot,
                            const VerificationOptions& options,
                            const PreparedLogs* log) {
  Verification result{kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, 0, 0, 0, {}};
  std::vector<ArmState> states =
      RandomStates(robot, options.random_states, options.seed);
  result.random_states = static_cast<int>(states.size());
  if (log != nullptr) {
    const auto logged =
        LoggedStates(options.log_states, options.progress, *log);
    states.insert(states.end(), logged.begin(), logged.end());
    result.log_states = static_cast<int>(logged.size());
  }
  result.reasons = Refusals(robot);
  if (result.reasons.empty()) {
    SimbodyArm arm(robot);
    CompareWithSimbody(robot, states, options.progress, &arm, &result);
    CompareSwings(robot, options, &arm, &result);
  } else {
    CompareSwings(robot, options, nullptr, &result);
  }
  result.own_consistency_rel = Inconsistency(robot, states);
  return result;
}

}  // namespace armcal
