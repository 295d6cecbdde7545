#include "tests/blind/structured_misfit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "model/plant/hidden/hidden_effect.h"
#include "model/plant/hidden/zero_velocity.h"
#include "model/plant/random_stream.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using JointMisfit = StructuredMisfit::JointMisfit;
using Ripple = StructuredMisfit::Ripple;

// Torque ripple of the catalogue begins at 6.
constexpr int kMostCycles = 5;
constexpr int kHalfCosines = 4;

// The displacement that counts as one radian: 0.3 m of a prismatic joint.
double Radian(JointType type) { return IsRotational(type) ? 1 : .3; }

double Rms(const VectorXd& x) { return std::sqrt(x.squaredNorm() / x.size()); }

// One or two waves of amplitude 1.
std::vector<Ripple> DrawRipples(std::mt19937_64* random) {
  std::uniform_int_distribution<int> first(1, kMostCycles),
      beyond(1, kMostCycles - 1), count(1, 2);
  std::uniform_real_distribution<double> phase(0, 2 * M_PI);
  const int cycles = first(*random);
  std::vector<Ripple> ripples = {
      {1, static_cast<double>(cycles), phase(*random)}};
  if (count(*random) == 2) {
    const int other = (cycles - 1 + beyond(*random)) % kMostCycles + 1;
    ripples.push_back({1, static_cast<double>(other), phase(*random)});
  }
  return ripples;
}

// Of the torque of these ripples along the log's positions.
double RippleRms(const JointMisfit& joint, JointType type, const VectorXd& q) {
  return Rms(q.unaryExpr(
      [&](double position) { return RippleTorque(joint, type, position); }));
}

// Ripples of rms kRippleShare along the log. Drawn again where the joint moves
// near nodes alone: elsewhere they would be far larger.
void AddRipples(JointType type, const VectorXd& q, std::mt19937_64* random,
                JointMisfit* joint) {
  double rms = 0, whole_turns = 0;
  do {
    joint->ripples = DrawRipples(random);
    rms = RippleRms(*joint, type, q);
    whole_turns = std::sqrt(joint->ripples.size() / 2.);
  } while (rms < whole_turns / 2);
  for (Ripple& ripple : joint->ripples) {
    ripple.amplitude = kRippleShare * joint->usual_torque / rms;
  }
}

// What turns the plant's law of friction at zero velocity into
// 2 / pi atan(pi / 2 v / width): as steep at zero, and much slower to its limit
// (1 - 0.4 width / v).
double LawDifference(double v, double width) {
  return 2 / M_PI * std::atan(M_PI / 2 * v / width) -
         ZeroVelocitySign(v, width);
}

void AddFrictionLaw(const EffectSite& site, double zero_velocity) {
  const double coulomb = site.link().joint.coulomb;
  const double width = zero_velocity * site.radian();
  const int k = site.from_tip();
  site.AddFriction([=](const ArmInstant& at, const double*, double*) {
    return -coulomb * LawDifference(FromTip(at.velocity, k), width);
  });
}

void AddTorques(const EffectSite& site, const JointMisfit& joint,
                const VectorXd& drift, double duration) {
  const JointType type = site.type();
  const int k = site.from_tip();
  site.AddTorque([=](const ArmInstant& at, const double*, double*) {
    return -RippleTorque(joint, type, FromTip(at.position, k)) -
           DriftTorque(drift, at.t / duration);
  });
}

// given = commanded / factor.
void AddTorqueFactors(const StructuredMisfit& misfit, SimulatedRobot* robot) {
  VectorXd factor(misfit.joints.size());
  for (int j = 0; j < factor.size(); ++j) {
    factor[j] = misfit.joints[j].torque_factor;
  }
  robot->actuators.push_back(
      {{},
       [factor](const ArmInstant&, const double*, double*, VectorXd* torque) {
         auto driven = torque->tail(factor.size());
         driven = driven.cwiseQuotient(factor);
       }});
}

}  // namespace

StructuredMisfit DrawMisfit(uint64_t seed, uint32_t attempt, const Robot& robot,
                            double zero_velocity, const Log& training) {
  std::mt19937_64 random = RandomStream(seed, attempt, RandomPurpose::kMisfit);
  std::normal_distribution<double> factor(1, kTorqueFactorSpread);
  StructuredMisfit misfit;
  misfit.seed = seed;
  misfit.zero_velocity = zero_velocity;
  for (int j = 0; j < robot.num_joints(); ++j) {
    JointMisfit joint;
    joint.usual_torque = Rms(training.tau.col(j));
    joint.torque_factor = factor(random);
    AddRipples(robot.links[j].joint.type, training.q.col(j), &random, &joint);
    misfit.joints.push_back(joint);
  }
  return misfit;
}

double RippleTorque(const JointMisfit& joint, JointType type, double position) {
  double torque = 0;
  for (const Ripple& ripple : joint.ripples) {
    torque += ripple.amplitude *
              std::sin(ripple.cycles * position / Radian(type) + ripple.phase);
  }
  return torque;
}

// Amplitudes fall as the frequency rises, as those of a random walk do.
MatrixXd DriftOf(const StructuredMisfit& misfit, uint64_t run) {
  std::mt19937_64 random =
      RandomStream(misfit.seed, run, RandomPurpose::kDrift);
  std::normal_distribution<double> normal;
  MatrixXd drift(misfit.joints.size(), kHalfCosines);
  for (int j = 0; j < drift.rows(); ++j) {
    for (int k = 0; k < kHalfCosines; ++k) {
      drift(j, k) = normal(random) / (k + 1);
    }
    // The half-cosines are orthogonal, each of mean square 1/2.
    drift.row(j) *= kDriftShare * misfit.joints[j].usual_torque /
                    (drift.row(j).norm() / std::sqrt(2.));
  }
  return drift;
}

double DriftTorque(const VectorXd& half_cosines, double share) {
  const double s = std::clamp(share, 0., 1.);
  double torque = 0;
  for (int k = 0; k < half_cosines.size(); ++k) {
    torque += half_cosines[k] * std::cos((k + 1) * M_PI * s);
  }
  return torque;
}

std::function<void(SimulatedRobot*)> PlantMisfit(const StructuredMisfit& misfit,
                                                 uint64_t run,
                                                 double duration) {
  return [=](SimulatedRobot* robot) {
    const MatrixXd drift = DriftOf(misfit, run);
    for (int j = 0; j < drift.rows(); ++j) {
      const EffectSite site = {robot, j, VectorXd(), nullptr};
      AddFrictionLaw(site, misfit.zero_velocity);
      AddTorques(site, misfit.joints[j], drift.row(j), duration);
    }
    AddTorqueFactors(misfit, robot);
  };
}

nlohmann::json ToJson(const StructuredMisfit& misfit,
                      const std::vector<std::string>& logs) {
  nlohmann::json joints = nlohmann::json::array(), drift;
  for (const JointMisfit& joint : misfit.joints) {
    nlohmann::json ripples = nlohmann::json::array();
    for (const Ripple& ripple : joint.ripples) {
      ripples.push_back({{"amplitude", ripple.amplitude},
                         {"cycles_per_turn", ripple.cycles},
                         {"phase", ripple.phase}});
    }
    joints.push_back({{"usual_torque", joint.usual_torque},
                      {"torque_factor", joint.torque_factor},
                      {"ripples", ripples}});
  }
  for (size_t run = 0; run < logs.size(); ++run) {
    const MatrixXd waves = DriftOf(misfit, run);
    for (const auto joint : waves.rowwise()) {
      drift[logs[run]].push_back(
          std::vector<double>(joint.begin(), joint.end()));
    }
  }
  return {{"zero_velocity_law", "arctangent"},
          {"zero_velocity", misfit.zero_velocity},
          {"joints", joints},
          {"drift", drift}};
}

}  // namespace armcal
