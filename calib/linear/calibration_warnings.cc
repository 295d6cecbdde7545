#include "calib/linear/calibration_warnings.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "calib/linear/transition_choice.h"
#include "model/text/enumeration.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// Whether the joint's Coulomb friction is in the model and seen.
bool SeesCoulomb(const LinearCalibration& result, int joint) {
  for (int k = 0; k < result.parameters.size(); ++k) {
    const ModelParameter& p = result.parameters.parameters()[k];
    if (p.is_joint_term && p.term == JointTerm::kCoulomb && p.block == joint) {
      return result.identifiable[k];
    }
  }
  return false;
}

// A width at the end of the grid is a bound and no estimate: over the speeds of
// the log, tanh(qd / width) is then nearly proportional to qd, which is viscous
// friction's column.
void WarnOfTransitions(const Robot& robot, const LinearCalibration& result,
                       std::vector<std::string>* sentences) {
  if (!result.solved || !result.fitted_transitions) return;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const CoulombTransition& t = result.transitions[i];
    if (t.width < LargestTransition(t.law) || !SeesCoulomb(result, i)) continue;
    const Joint& joint = robot.links[i].joint;
    const bool velocity = t.law == CoulombTransition::Law::kVelocity;
    sentences->push_back(
        joint.name +
        Format(
            ": Coulomb friction changes sign over %.3g %s%s, the largest "
            "width that is tried: viscous and Coulomb friction trade; raise ",
            t.width, PositionUnit(joint.type), velocity ? "/s" : "") +
        OptionName("bandwidth") + ", log faster reversals, or give " +
        OptionName("coulomb_width"));
  }
}

// By chance a residual's rms differs from log to log by some hundredths where
// they have hundreds of independent samples. Twice as much is another friction,
// an effect that the model lacks, or parameters that the fitted motion told too
// little of: none of which the standard deviations hold.
constexpr double kCarriesOver = 2;

void WarnOfHeldOut(const Robot& robot, const LinearCalibration& result,
                   std::vector<std::string>* sentences) {
  if (!result.solved || !result.training || !result.validation) return;
  const TorqueResidual::Figures fit = result.training->moving();
  const TorqueResidual::Figures held_out = result.validation->moving();
  std::string joints;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (held_out.residual_rms[i] > kCarriesOver * fit.residual_rms[i] &&
        held_out.percent[i] > kCarriesOver * fit.percent[i]) {
      joints += (joints.empty() ? "" : ", ") + robot.links[i].joint.name +
                Format(" (%.3g %%, fitted %.3g %%)", held_out.percent[i],
                       fit.percent[i]);
    }
  }
  if (joints.empty()) return;
  sentences->push_back(
      "held out, more than twice as much of the torque is left as where it was "
      "fitted: " +
      joints +
      ". The robot was another then (warmer, loaded), the model lacks what "
      "that motion shows, or the fitted motion told too little; a diagnosis "
      "may say which");
}

// Standard deviations below zero: one in thirty thousand by chance, and what
// the model lacks may be as much again.
constexpr double kBeyondChance = 4;

// An estimate u' x of a combination u of the parameters.
struct BoundedEstimate {
  double value = 0, stddev = 0;
  bool IsNegative() const { return value < -kBeyondChance * stddev; }
  bool IsPositive() const { return value > kBeyondChance * stddev; }
};

BoundedEstimate EstimateOf(const Eigen::VectorXd& u,
                           const LinearCalibration& result) {
  for (int k = 0; k < u.size(); ++k) {
    if (u[k] != 0 && !result.identifiable[k]) return {0, 1};
  }
  // A column that does not count may have a variance that is not finite.
  double variance = 0;
  for (int r = 0; r < u.size(); ++r) {
    for (int c = 0; u[r] != 0 && c < u.size(); ++c) {
      if (u[c] != 0) variance += u[r] * u[c] * result.covariance(r, c);
    }
  }
  return {u.dot(result.x), std::sqrt(variance)};
}

// Rows of the joints: the combination that is the inertia about the joint's
// axis, the torque of a unit of its own acceleration, in the mean of postures.
// That is the mass matrix' diagonal M_jj(q), armature included, which is twice
// the kinetic energy of a unit of speed: positive at each posture, whatever the
// arm. Single parameters that are made of several links' are of either sign.
Eigen::MatrixXd MeanInertias(const ModelParameters& parameters) {
  constexpr int kPostures = 32;
  const int n = parameters.num_joints();
  Regressor regressor = parameters.MakeRegressor();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(n, parameters.size());
  const auto& terms = regressor.columns().terms;
  const Eigen::VectorXd unloaded = Eigen::VectorXd::Zero(std::count_if(
      terms.begin(), terms.end(), [](const JointTermColumn& term) {
        return term.term == JointTerm::kCoulomb;
      }));
  Eigen::MatrixXd moved, still;
  for (int posture = 0; posture < kPostures; ++posture) {
    Eigen::VectorXd q(n);
    for (double& one : q) one = angle(random);
    regressor.Differential(q, rest, rest, unloaded, &still);
    for (int j = 0; j < n; ++j) {
      regressor.Differential(q, rest, Eigen::VectorXd::Unit(n, j), unloaded,
                             &moved);
      mean.row(j) += (moved.row(j) - still.row(j)) / kPostures;
    }
  }
  // Where a column cancels by arithmetic, it is not there.
  return (mean.array().abs() > 1e-12).select(mean, 0);
}

// The columns of a joint's term; with Coulomb friction that is not in the model
// there are none.
Eigen::VectorXd ColumnsOf(JointTerm term, int joint,
                          const ModelParameters& parameters) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(parameters.size());
  for (int k = 0; k < parameters.size(); ++k) {
    const ModelParameter& p = parameters.parameters()[k];
    if (p.is_joint_term && p.term == term && p.block == joint) u[k] = 1;
  }
  return u;
}

bool HasHardlyTorque(const LinearCalibration& result, int joint) {
  return std::any_of(
      result.unpowered.begin(), result.unpowered.end(),
      [joint](const UnpoweredJoint& u) { return u.joint == joint; });
}

// What makes a joint's estimates negative. Negated torques do so with both what
// its inertia is and what its friction is at the speed that it has (its rms),
// which then gives power. Where one of the two is positive beyond doubt no sign
// is wrong, and the model lacks something: Coulomb friction is below zero where
// friction grows less than in proportion to speed, on logs of real arms, too.
std::string CauseOfNegative(const BoundedEstimate& inertia,
                            const BoundedEstimate& friction) {
  const char* const of_the_model =
      "its friction has another law, or the motion tells too little";
  if (friction.IsPositive()) {
    return std::string(
               "no sign is wrong, as friction takes power at the "
               "speed it has; ") +
           of_the_model;
  }
  if (inertia.IsPositive()) {
    return std::string("no sign is wrong, as its inertia is above zero; ") +
           of_the_model;
  }
  if (!inertia.IsNegative() && !friction.IsNegative()) return of_the_model;
  return "as where its torque, or its position and velocity, has the wrong "
         "sign "
         "(armcal inspect), or the motion tells too little";
}

// Nothing is said of joints that hardly have a torque.
void WarnOfNegative(const Robot& robot, const LinearCalibration& result,
                    std::vector<std::string>* sentences) {
  if (!result.solved) return;
  const ModelParameters& parameters = result.parameters;
  const Eigen::MatrixXd inertias = MeanInertias(parameters);
  for (int j = 0; j < parameters.num_joints(); ++j) {
    if (HasHardlyTorque(result, j)) continue;
    const Joint& joint = robot.links[j].joint;
    std::vector<std::string> told;
    const auto tell = [&](const char* what, const BoundedEstimate& estimate,
                          JointTerm term) {
      if (!estimate.IsNegative()) return;
      told.push_back(what +
                     Format(" %.3g +- %.2g ", estimate.value, estimate.stddev) +
                     JointTermUnit(term, joint.type));
    };
    const Eigen::VectorXd u = ColumnsOf(JointTerm::kViscous, j, parameters);
    const Eigen::VectorXd v = ColumnsOf(JointTerm::kCoulomb, j, parameters);
    const BoundedEstimate inertia = EstimateOf(inertias.row(j), result);
    const BoundedEstimate friction =
        EstimateOf(std::sqrt(result.mean_square_speed[j]) * u + v, result);
    tell("inertia (with armature)", inertia, JointTerm::kArmature);
    tell("viscous friction", EstimateOf(u, result), JointTerm::kViscous);
    tell("Coulomb friction", EstimateOf(v, result), JointTerm::kCoulomb);
    // Where the motion tells it from the links' inertia, which may outweigh it.
    const Eigen::VectorXd a = ColumnsOf(JointTerm::kArmature, j, parameters);
    if (!inertia.IsNegative()) {
      tell("armature", EstimateOf(a, result), JointTerm::kArmature);
    }
    if (told.empty()) continue;
    sentences->push_back(joint.name + ": " + Enumeration(told) +
                         (told.size() > 1 ? " are" : " is") +
                         " below zero, which no joint has: " +
                         CauseOfNegative(inertia, friction));
  }
}

// Rows in which all joints leave their motion are one thing to say, not one for
// each joint.
void WarnOfSpikes(const Robot& robot, const LinearCalibration& result,
                  std::vector<std::string>* sentences) {
  const auto& spikes = result.position_spikes;
  if (spikes.size() > 1 && spikes[0] > 0 && (spikes == spikes[0]).all()) {
    const bool one = spikes[0] == 1;
    sentences->push_back(Format(
        "%ld wrong row%s left out, at which all joints leave their motion at "
        "once; armcal inspect says when",
        spikes[0], one ? " was" : "s were"));
    return;
  }
  for (int i = 0; i < spikes.size(); ++i) {
    const long rows = spikes[i];
    if (rows == 0) continue;
    sentences->push_back(
        robot.links[i].joint.name +
        Format(": %ld wrong sample%s of its position %s left out, at which it "
               "leaves its motion and comes back; armcal inspect says when",
               rows, rows == 1 ? "" : "s", rows == 1 ? "was" : "were"));
  }
}

}  // namespace

std::vector<std::string> CalibrationWarnings(const Robot& robot,
                                             const LinearCalibration& result) {
  std::vector<std::string> sentences;
  WarnOfSpikes(robot, result, &sentences);
  WarnOfNegative(robot, result, &sentences);
  WarnOfTransitions(robot, result, &sentences);
  WarnOfHeldOut(robot, result, &sentences);
  return sentences;
}

}  // namespace armcal
