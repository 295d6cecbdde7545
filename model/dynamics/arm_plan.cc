#include "model/dynamics/arm_plan.h"

#include <glog/logging.h>

#include <cmath>

namespace armcal {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// R = Rz(first) Rx(beta) Rz(last).
struct EulerAngles {
  double first, cosine_beta, sine_beta, last;
};

EulerAngles AnglesOf(const Matrix3d& R) {
  const double sine = std::hypot(R(0, 2), R(1, 2));
  EulerAngles angles{0, R(2, 2), sine, 0};
  if (sine > 0) angles.first = std::atan2(R(0, 2), -R(1, 2));
  // What is left is a rotation about z wherever `first`, of axes that are
  // parallel but for rounding, came to lie.
  const Matrix3d Rz = AngleAxisd(angles.first, Vector3d::UnitZ()).matrix();
  Matrix3d Rx = Matrix3d::Identity();
  Rx.bottomRightCorner<2, 2>() << R(2, 2), -sine, sine, R(2, 2);
  const Matrix3d left = Rx.transpose() * Rz.transpose() * R;
  angles.last = std::atan2(left(1, 0), left(0, 0));
  return angles;
}

Isometry3d TurnedBy(double angle) {
  return Isometry3d(AngleAxisd(angle, Vector3d::UnitZ()));
}

void SetBody(const InertialParameters& body, double* to) {
  const Eigen::Matrix4d moments = PseudoInertia(body.ToVector());
  const int J = simd::kSecondMoment;
  for (int k = 0; k < 3; ++k) {
    to[simd::kFirstMoment + k] = body.first_moment[k];
  }
  to[J] = moments(0, 0);
  to[J + 1] = moments(0, 1);
  to[J + 2] = moments(0, 2);
  to[J + 3] = moments(1, 1);
  to[J + 4] = moments(1, 2);
  to[J + 5] = moments(2, 2);
  to[simd::kMassOfBody] = body.mass;
}

void SetJoint(const RolloutArm& arm, int j, double* to) {
  const Joint& joint = arm.robot.links[j].joint;
  to[simd::kArmatureOfJoint] = joint.armature;
  to[simd::kViscous] = joint.viscous;
  to[simd::kCoulomb] = joint.coulomb;
  to[simd::kOffset] = joint.offset;
  const CoulombTransition transition =
      arm.transitions.empty() ? CoulombTransition() : arm.transitions[j];
  to[simd::kInverseWidth] = 1 / transition.width;
  if (arm.springs.empty()) return;
  to[simd::kStiffness] = arm.springs[j].stiffness;
  to[simd::kRest] = arm.springs[j].rest;
}

// The numbers of a path's bodies as a chain, in the order of
// ArmConstants::values. Each rotation between joints is Rz Rx Rz; its two turns
// about z are added to the joints on either side, which turn about z anyway, so
// that kernels are left with one rotation about x. `joint_terms`: with what the
// joints add.
VectorXd ValuesOf(const RolloutArm& arm, const LinkPath& path,
                  bool joint_terms) {
  const Robot& robot = arm.robot;
  const int n = static_cast<int>(path.links.size());
  VectorXd values = VectorXd::Zero(3 + n * simd::kNumBodyConstants);
  const auto body = [&](int i) {
    return values.data() + 3 + i * simd::kNumBodyConstants;
  };
  const auto set_body = [&](int i, const Isometry3d& X_ML) {
    if (i < path.first_own) return;
    SetBody(robot.links[path.links[i]].inertial.ReexpressIn(X_ML), body(i));
  };
  for (int i = 0; i < n; ++i) {
    const Link& link = robot.links[path.links[i]];
    const Isometry3d X_MF =
        i == 0 ? link.X_PF : robot.links[path.links[i - 1]].X_ML * link.X_PF;
    const EulerAngles angles = AnglesOf(X_MF.linear());
    // The frame before takes the first angle on, and so does its joint.
    const Isometry3d turned = TurnedBy(-angles.first);
    const Vector3d p = turned * X_MF.translation();
    double* to = body(i);
    to[simd::kCosineBeta] = angles.cosine_beta;
    to[simd::kSineBeta] = angles.sine_beta;
    to[simd::kAngle] = angles.last;
    for (int k = 0; k < 3; ++k) to[simd::kPosition + k] = p[k];
    if (i == 0) {
      values.head<3>() = turned * robot.gravity;
    } else {
      body(i - 1)[simd::kAngle] += angles.first;
      set_body(i - 1, turned * robot.links[path.links[i - 1]].X_ML);
    }
    if (joint_terms) SetJoint(arm, path.links[i], to);
  }
  set_body(n - 1, robot.links[path.links[n - 1]].X_ML);
  double mass = 0;
  for (int i = n - 1; i >= 0; --i) {
    mass += body(i)[simd::kMassOfBody];
    body(i)[simd::kMassBeyond] = mass;
  }
  return values;
}

// The joints' own numbers of a robot that branches, whose bodies are its
// paths'.
VectorXd JointValuesOf(const RolloutArm& arm) {
  const int n = arm.robot.num_joints();
  VectorXd values = VectorXd::Zero(3 + n * simd::kNumBodyConstants);
  for (int j = 0; j < n; ++j) {
    SetJoint(arm, j, values.data() + 3 + j * simd::kNumBodyConstants);
  }
  return values;
}

// Of each lane's arm, a number of every lane after the other.
template <class ValuesOfArm>
AlignedNumbers OfAllLanes(const std::vector<const RolloutArm*>& arms,
                          const ValuesOfArm& values_of) {
  const size_t lanes = arms.size();
  VectorXd values;
  AlignedNumbers all;
  for (size_t k = 0; k < lanes; ++k) {
    if (k == 0 || arms[k] != arms[k - 1]) values = values_of(*arms[k]);
    if (k == 0) all = AlignedNumbers(lanes * values.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      all.data()[i * lanes + k] = values[i];
    }
  }
  return all;
}

simd::Transition TransitionOf(const RolloutArm& arm, int j) {
  if (arm.robot.links[j].joint.coulomb == 0) return simd::Transition::kNone;
  return arm.transitions.empty() ||
                 arm.transitions[j].law == CoulombTransition::Law::kVelocity
             ? simd::Transition::kVelocity
             : simd::Transition::kDisplacement;
}

}  // namespace

ArmPlan::ArmPlan(const RolloutArm& arm, int lanes)
    : ArmPlan(std::vector<const RolloutArm*>(lanes, &arm)) {}

ArmPlan::ArmPlan(const std::vector<const RolloutArm*>& arm_of_lane) {
  SetJoints(arm_of_lane);
  const Robot& robot = arm_of_lane[0]->robot;
  links_ = PathsOf(robot.parents, robot.num_joints());
  for (const RolloutArm* arm : arm_of_lane) {
    CHECK(arm->robot.parents == robot.parents);
  }
  if (!robot.branches()) {
    values_ = OfAllLanes(arm_of_lane, [this](const RolloutArm& arm) {
      return ValuesOf(arm, links_[0], true);
    });
  } else {
    values_ = OfAllLanes(arm_of_lane, JointValuesOf);
    for (const LinkPath& path : links_) AddPath(arm_of_lane, path);
    for (size_t p = 0; p < paths_.size(); ++p) {
      paths_[p].chain.joints = path_joints_[p].data();
      paths_[p].chain.values = path_values_[p].data();
    }
  }
  constants_.joints = joints_.data();
  constants_.values = values_.data();
  constants_.num_paths = static_cast<int>(paths_.size());
  constants_.paths = paths_.data();
}

void ArmPlan::AddPath(const std::vector<const RolloutArm*>& arms,
                      const LinkPath& path) {
  path_values_.push_back(OfAllLanes(arms, [&path](const RolloutArm& arm) {
    return ValuesOf(arm, path, false);
  }));
  path_joints_.emplace_back();
  for (const int i : path.links) {
    simd::JointKind kind;
    kind.rotational = joints_[i].rotational;
    path_joints_.back().push_back(kind);
  }
  simd::ArmPath part{};
  part.chain.num_joints = static_cast<int>(path.links.size());
  part.joints = path.links.data();
  paths_.push_back(part);
}

// Lanes go through the same instructions: their arms must have the same kinds
// of joints and laws, while their numbers may differ.
void ArmPlan::SetJoints(const std::vector<const RolloutArm*>& arms) {
  const size_t n = arms[0]->robot.links.size();
  CHECK_GT(n, 0u);
  constants_.num_joints = static_cast<int>(n);
  joints_.resize(n);
  for (const RolloutArm* arm : arms) {
    CHECK_EQ(arm->robot.links.size(), n);
    CHECK(arm->transitions.empty() || arm->transitions.size() == n);
    CHECK(arm->springs.empty() || arm->springs.size() == n);
    for (size_t j = 0; j < n; ++j) {
      const Joint& joint = arm->robot.links[j].joint;
      simd::JointKind& kind = joints_[j];
      if (arm == arms[0]) kind.rotational = IsRotational(joint.type);
      CHECK_EQ(IsRotational(joint.type), kind.rotational) << joint.name;
      const simd::Transition transition = TransitionOf(*arm, j);
      if (transition != simd::Transition::kNone) {
        CHECK(kind.transition == simd::Transition::kNone ||
              kind.transition == transition)
            << joint.name << ": laws of friction differ between lanes";
        kind.transition = transition;
      }
      kind.has_spring |=
          !arm->springs.empty() && arm->springs[j].stiffness != 0;
      constants_.has_joint_terms |= joint.viscous != 0 || kind.has_spring ||
                                    transition != simd::Transition::kNone;
    }
  }
}

}  // namespace armcal
