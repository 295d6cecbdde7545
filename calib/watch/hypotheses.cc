#include "calib/watch/hypotheses.h"

#include <algorithm>
#include <cmath>

#include "model/robot/kinematics.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kWrench = 6;

// The largest distance of the last link from the base among a few postures, m.
double Reach(const Robot& robot) {
  double reach = 0;
  for (const double bend : {0., .5, 1., -1., 1.5, -1.5}) {
    VectorXd q(robot.num_joints());
    for (int k = 0; k < q.size(); ++k) q[k] = bend * std::sin(1. + k);
    reach = std::max(reach, LinkPoses(robot, q).back().translation().norm());
  }
  return std::max(reach, 1e-3);
}

// A mass that the arm feels: what its calibrated torques would lift at half of
// its reach, kg.
double FeltMass(const WatchModel& model) {
  constexpr double kGravity = 9.81;
  return std::max(
      model.torque_rms.maxCoeff() / (kGravity * Reach(model.robot) / 2), 1e-6);
}

// A body of a tenth of what the torques of the calibration lift (a tenth of
// them is what a change has to be to matter), its centre within a tenth of the
// arm's reach from the last link's origin; inertias of such a body.
WatchHypothesis Payload(const WatchModel& model) {
  const double mass = .3 * FeltMass(model);
  const double arm = .1 * Reach(model.robot);
  WatchHypothesis change;
  change.kind = WatchHypothesis::Kind::kPayload;
  change.columns = MatrixXd::Zero(model.columns() + kWrench, 10);
  change.columns.topRows(model.size()) = PayloadColumns(model);
  change.stddev.resize(10);
  for (int k = 0; k < 10; ++k) {
    change.stddev[k] = k == 0 ? mass : k < 4 ? mass * arm : mass * arm * arm;
    change.names.push_back(InertialName(k));
    change.units.push_back(InertialUnit(k));
  }
  return change;
}

// Half of what the joint has; of what it does not have, 2 % of its torque (its
// viscous part at 1 rad/s or m/s), which a diagnosis takes for worth naming.
WatchHypothesis Friction(const WatchModel& model, int j) {
  const Joint& joint = model.robot.links[j].joint;
  const double least = .02 * model.torque_rms[j];
  WatchHypothesis change;
  change.kind = WatchHypothesis::Kind::kFriction;
  change.joint = j;
  std::vector<double> stddev;
  std::vector<int> places;
  for (const JointTerm term :
       {JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset}) {
    const int place = TermColumn(model.parameters, j, term);
    if (place < 0) continue;
    const double has =
        term == JointTerm::kOffset ? joint.coulomb : TermOf(term, joint);
    places.push_back(place);
    stddev.push_back(std::max(.5 * std::abs(has), least));
    change.names.push_back(JointTermName(term));
    change.units.push_back(JointTermUnit(term, joint.type));
  }
  change.columns = MatrixXd::Zero(model.columns() + kWrench, places.size());
  for (size_t k = 0; k < places.size(); ++k) change.columns(places[k], k) = 1;
  change.stddev = VectorXd::Map(stddev.data(), stddev.size());
  return change;
}

// The weight of the payload above, and its moment at a tenth of the reach.
WatchHypothesis Contact(const WatchModel& model) {
  constexpr double kGravity = 9.81;
  const double force = .3 * FeltMass(model) * kGravity;
  WatchHypothesis change;
  change.kind = WatchHypothesis::Kind::kContact;
  change.columns = MatrixXd::Zero(model.columns() + kWrench, kWrench);
  change.columns.bottomRows(kWrench).setIdentity();
  change.stddev = VectorXd::Constant(kWrench, force);
  change.stddev.tail(3) *= .1 * Reach(model.robot);
  change.names = {"fx", "fy", "fz", "mx", "my", "mz"};
  change.units = {"N", "N", "N", "N m", "N m", "N m"};
  return change;
}

}  // namespace

std::vector<WatchHypothesis> MakeWatchHypotheses(const WatchModel& model) {
  std::vector<WatchHypothesis> hypotheses = {Payload(model)};
  for (int j = 0; j < model.num_joints(); ++j) {
    hypotheses.push_back(Friction(model, j));
  }
  hypotheses.push_back(Contact(model));
  return hypotheses;
}

MatrixXd WithChange(const MatrixXd& covariance, const WatchHypothesis& change,
                    const VectorXd& variance) {
  const MatrixXd B = change.columns.topRows(covariance.rows());
  return covariance + B * variance.asDiagonal() * B.transpose();
}

}  // namespace armcal
