#include "calib/gap_baseline.h"

#include <glog/logging.h>

#include <array>
#include <cmath>

#include "model/link_regressor.h"
#include "model/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Widths of tanh(qd / width), rad/s (0.3 of it in m/s): friction changes sign
// as the first, or as any mixture of it and the others.
constexpr double kReferenceWidth = 6e-3;
constexpr std::array<double, 5> kOtherWidths = {1.5e-3, 3e-3, 12e-3, 24e-3,
                                                48e-3};
// Of the joint's Coulomb friction, how much may change sign otherwise.
constexpr double kMixture = .5;
// A torque's zero is not known better than this share of its usual size.
constexpr double kOffsetShare = .02;

double WidthUnit(const Joint& joint) {
  return IsRotational(joint.type) ? 1 : .3;
}

}  // namespace

GapBaseline::GapBaseline(const Robot& robot, const BaselineOptions& options,
                         const VectorXd& usual_torque)
    : robot_(robot) {
  const int n = robot.num_joints();
  CHECK_EQ(usual_torque.size(), n);
  for (int j = 0; j < n; ++j) {
    CoulombTransition transition;
    transition.width = kReferenceWidth * WidthUnit(robot.links[j].joint);
    transitions_.push_back(transition);
    AddLink(j, options.trust);
    AddTerms(j, options.trust, usual_torque[j]);
  }
  columns_.push_back({BaselineColumn::Kind::kTiming, -1, 0, options.timing_s});
}

void GapBaseline::AddLink(int link, double trust) {
  const InertialParameters& inertial = robot_.links[link].inertial;
  if (inertial.mass <= 0) return;
  const double size = std::sqrt(inertial.inertia.trace() / 2 / inertial.mass);
  for (int k = 0; k < 10; ++k) {
    const double lever = k == 0 ? 1 : k < 4 ? size : size * size;
    columns_.push_back({BaselineColumn::Kind::kInertial, link, k,
                        trust * inertial.mass * lever});
  }
}

void GapBaseline::AddTerms(int j, double trust, double usual_torque) {
  const Joint& joint = robot_.links[j].joint;
  const auto add = [&](JointTerm term, double spread) {
    if (spread <= 0) return;
    columns_.push_back(
        {BaselineColumn::Kind::kTerm, j, static_cast<int>(term), spread});
  };
  add(JointTerm::kArmature, trust * std::abs(joint.armature));
  add(JointTerm::kViscous, trust * std::abs(joint.viscous));
  add(JointTerm::kCoulomb, trust * std::abs(joint.coulomb));
  add(JointTerm::kOffset,
      trust * std::max(std::abs(joint.coulomb), kOffsetShare * usual_torque));
  if (joint.coulomb == 0) return;
  for (size_t k = 0; k < kOtherWidths.size(); ++k) {
    columns_.push_back({BaselineColumn::Kind::kZeroVelocity, j,
                        static_cast<int>(k), kMixture * joint.coulomb});
  }
}

std::vector<MatrixXd> GapBaseline::ThinColumns(
    const GapRows& rows, const std::vector<RecordedTorque>& torques) const {
  const int n = robot_.num_joints();
  std::vector<MatrixXd> thin(n, MatrixXd::Zero(rows.num_thin(), size()));
  for (size_t s = 0; s < rows.segments().size(); ++s) {
    const Motion& motion = rows.segments()[s].motion;
    const int begin = rows.thin_begin(static_cast<int>(s));
    const int size_s = rows.thin_begin(static_cast<int>(s) + 1) - begin;
    const int samples = motion.size();
    LinkRegressor regressor(robot_);
    MatrixXd P, D;
    // Momentum of joint j per unit of each inertial parameter of the links
    // from j on; inertial columns are differentiated in time.
    std::vector<MatrixXd> momentum(n), force(n);
    for (int j = 0; j < n; ++j) {
      momentum[j].resize(samples, 10 * n);
      force[j].resize(samples, 10 * n);
    }
    for (int k = 0; k < samples; ++k) {
      regressor.Momentum(motion.q.row(k), motion.qd.row(k), &P, &D);
      for (int j = 0; j < n; ++j) {
        momentum[j].row(k) = P.row(j);
        force[j].row(k) = D.row(j);
      }
    }
    const MatrixXd rate = Differentiate(torques[s].nominal(), motion.dt);
    for (int j = 0; j < n; ++j) {
      MatrixXd fine = MatrixXd::Zero(samples, size());
      const MatrixXd torque = Differentiate(momentum[j], motion.dt) - force[j];
      const double reference = transitions_[j].width;
      for (int c = 0; c < size(); ++c) {
        const BaselineColumn& column = columns_[c];
        const auto qd = motion.qd.col(j).array();
        switch (column.kind) {
          case BaselineColumn::Kind::kInertial:
            if (column.joint < j) break;
            fine.col(c) = torque.col(10 * column.joint + column.index);
            break;
          case BaselineColumn::Kind::kTerm:
            if (column.joint != j) break;
            switch (static_cast<JointTerm>(column.index)) {
              case JointTerm::kArmature:
                fine.col(c) = motion.qdd.col(j);
                break;
              case JointTerm::kViscous:
                fine.col(c) = motion.qd.col(j);
                break;
              case JointTerm::kCoulomb:
                fine.col(c) = (qd / reference).tanh();
                break;
              case JointTerm::kOffset:
                fine.col(c).setOnes();
                break;
            }
            break;
          case BaselineColumn::Kind::kZeroVelocity: {
            if (column.joint != j) break;
            const double width =
                kOtherWidths[column.index] * WidthUnit(robot_.links[j].joint);
            fine.col(c) = (qd / width).tanh() - (qd / reference).tanh();
            break;
          }
          case BaselineColumn::Kind::kTiming:
            fine.col(c) = -rate.col(j);
            break;
        }
        fine.col(c) *= column.spread;
      }
      thin[j].middleRows(begin, size_s) = rows.Thin(static_cast<int>(s), fine);
    }
  }
  return thin;
}

Robot GapBaseline::With(const VectorXd& x) const {
  CHECK_EQ(x.size(), size());
  Robot robot = robot_;
  for (int c = 0; c < size(); ++c) {
    const BaselineColumn& column = columns_[c];
    const double value = x[c] * column.spread;
    if (column.kind == BaselineColumn::Kind::kInertial) {
      Vector10d v = Vector10d::Zero();
      v[column.index] = value;
      robot.links[column.joint].inertial += InertialParameters::FromVector(v);
    } else if (column.kind == BaselineColumn::Kind::kTerm) {
      Joint& joint = robot.links[column.joint].joint;
      switch (static_cast<JointTerm>(column.index)) {
        case JointTerm::kArmature:
          joint.armature += value;
          break;
        case JointTerm::kViscous:
          joint.viscous += value;
          break;
        case JointTerm::kCoulomb:
          joint.coulomb += value;
          break;
        case JointTerm::kOffset:
          joint.offset += value;
          break;
      }
    }
  }
  return robot;
}

std::vector<RecordedTorque> RecordedTorques(const GapBaseline& baseline,
                                            const GapRows& rows) {
  std::vector<RecordedTorque> torques;
  for (const GapSegment& segment : rows.segments()) {
    torques.emplace_back(baseline.robot(), baseline.transitions(),
                         segment.motion);
  }
  return torques;
}

}  // namespace armcal
