#include "model/robot/arm_geometry.h"

#include <glog/logging.h>

#include <cmath>

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Kind = ElementaryTransform::Kind;

constexpr double kParallelWithin = 0.1;  // rad

struct Row {
  double theta = 0, d = 0, a = 0, alpha = 0, beta = 0;
};

// Of X = Rz(theta) Tz(d) Tx(a) Rx(alpha) Ry(beta); beta = 0 where axes are far
// from parallel, as it would not be told from theta at alpha = pi/2.
Row StandardRow(const Isometry3d& X) {
  const Eigen::Matrix3d& R = X.linear();
  const Vector3d p = X.translation();
  Row row;
  if (std::abs(R(2, 2)) > 0.5) {
    const double sign = R(2, 2) < 0 ? -1 : 1;  // of cos(alpha)
    row.beta = std::atan2(-sign * R(2, 0), sign * R(2, 2));
    row.alpha = std::atan2(R(2, 1), sign * std::hypot(R(2, 0), R(2, 2)));
    row.theta = std::atan2(-sign * R(0, 1), sign * R(1, 1));
  } else {
    row.alpha = std::atan2(R(2, 1), R(2, 2));
    row.theta = std::atan2(R(1, 0), R(0, 0));
  }
  row.d = p.z();
  row.a = p.x() * std::cos(row.theta) + p.y() * std::sin(row.theta);
  return row;
}

// Of X_PF = Rx(alpha) Ry(beta) Tx(a), X_ML = Rz(theta) Tz(d).
Row ModifiedRow(const Isometry3d& X_PF, const Isometry3d& X_ML) {
  const Eigen::Matrix3d& R = X_PF.linear();
  Row row;
  row.alpha = std::atan2(R(2, 1), R(1, 1));
  row.beta = std::atan2(R(0, 2), R(0, 0));
  row.a = R.col(0).dot(X_PF.translation());
  row.theta = std::atan2(X_ML.linear()(1, 0), X_ML.linear()(0, 0));
  row.d = X_ML.translation().z();
  return row;
}

bool NearlyParallel(const Robot& robot, int i) {
  const int next = robot.next(i);
  if (next < 0) return false;
  const Isometry3d X = robot.links[i].X_ML * robot.links[next].X_PF;
  return std::hypot(X.linear()(0, 2), X.linear()(1, 2)) < kParallelWithin;
}

Isometry3d Product(const std::vector<ElementaryTransform>& steps, int begin,
                   int end) {
  Isometry3d X = Isometry3d::Identity();
  for (int k = begin; k < end; ++k) steps[k].Append(steps[k].value, &X);
  return X;
}

}  // namespace

// A rotation about an axis turns the two other axes of X in their plane.
void ElementaryTransform::Append(double amount, Isometry3d* X) const {
  if (kind == Kind::kConstant) {
    *X = *X * constant;
    return;
  }
  if (amount == 0) return;
  if (kind == Kind::kTranslation) {
    X->translation() += amount * X->linear().col(axis);
    return;
  }
  const double c = std::cos(amount), s = std::sin(amount);
  auto a = X->linear().col((axis + 1) % 3);
  auto b = X->linear().col((axis + 2) % 3);
  const Vector3d turned = c * a + s * b;
  b = (c * b - s * a).eval();
  a = turned;
}

void ArmGeometry::Add(Kind kind, int axis, double value,
                      const std::string& name) {
  ElementaryTransform step;
  step.kind = kind;
  step.axis = axis;
  step.value = value;
  step.name = name;
  if (!name.empty()) {
    step.parameter = size();
    parameters_.push_back(static_cast<int>(steps_.size()));
  }
  steps_.push_back(step);
}

void ArmGeometry::AddJoint(const Joint& joint, int index) {
  const bool rotational = IsRotational(joint.type);
  Add(rotational ? Kind::kRotation : Kind::kTranslation, 2, 0, "");
  steps_.back().joint = index;
}

void ArmGeometry::AddConstant(const Isometry3d& X) {
  Add(Kind::kConstant, 2, 0, "");
  steps_.back().constant = X;
}

// x y z, then yaw pitch roll: R = Rz Ry Rx, the URDF's order.
void ArmGeometry::AddPose(const std::string& owner, const Isometry3d& X) {
  const Eigen::Matrix3d& R = X.linear();
  const double yaw = std::atan2(R(1, 0), R(0, 0));
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  const double roll = std::atan2(R(2, 1), R(2, 2));
  const Vector3d p = X.translation();
  Add(Kind::kTranslation, 0, p.x(), owner + ".x");
  Add(Kind::kTranslation, 1, p.y(), owner + ".y");
  Add(Kind::kTranslation, 2, p.z(), owner + ".z");
  Add(Kind::kRotation, 2, yaw, owner + ".yaw");
  Add(Kind::kRotation, 1, pitch, owner + ".pitch");
  Add(Kind::kRotation, 0, roll, owner + ".roll");
}

void ArmGeometry::AddStandardRow(const Link& link, int index, bool hayati) {
  const Row dh = StandardRow(link.X_ML);
  AddJoint(link.joint, index);
  Add(Kind::kRotation, 2, dh.theta, link.name + ".theta");
  Add(Kind::kTranslation, 2, dh.d, link.name + ".d");
  Add(Kind::kTranslation, 0, dh.a, link.name + ".a");
  Add(Kind::kRotation, 0, dh.alpha, link.name + ".alpha");
  if (hayati) Add(Kind::kRotation, 1, dh.beta, link.name + ".beta");
}

void ArmGeometry::AddModifiedRow(const Link& link, int index, bool hayati) {
  const Row dh = ModifiedRow(link.X_PF, link.X_ML);
  Add(Kind::kRotation, 0, dh.alpha, link.name + ".alpha");
  if (hayati) Add(Kind::kRotation, 1, dh.beta, link.name + ".beta");
  Add(Kind::kTranslation, 0, dh.a, link.name + ".a");
  AddJoint(link.joint, index);
  Add(Kind::kRotation, 2, dh.theta, link.name + ".theta");
  Add(Kind::kTranslation, 2, dh.d, link.name + ".d");
}

void ArmGeometry::AddUrdfLink(const Link& link, int index) {
  // X_PF = origin * (z axis onto the joint's axis); X_ML undoes the latter.
  AddPose(link.name, link.X_PF * link.X_ML);
  AddConstant(link.X_ML.inverse());
  AddJoint(link.joint, index);
  Add(IsRotational(link.joint.type) ? Kind::kRotation : Kind::kTranslation, 2,
      0, link.name + ".theta");
  AddConstant(link.X_ML);
}

ArmGeometry::ArmGeometry(const Robot& robot) : parents_(robot.parents) {
  AddPose("base", Isometry3d::Identity());
  base_end_ = static_cast<int>(steps_.size());
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Link& link = robot.links[i];
    LinkSteps range;
    range.begin = static_cast<int>(steps_.size());
    if (robot.dh_convention == DhConvention::kStandard) {
      AddStandardRow(link, i, NearlyParallel(robot, i));
    } else if (robot.dh_convention == DhConvention::kModified) {
      AddModifiedRow(link, i, i > 0 && NearlyParallel(robot, i - 1));
    } else {
      AddUrdfLink(link, i);
    }
    range.end = static_cast<int>(steps_.size());
    range.joint = range.begin;
    while (steps_[range.joint].joint < 0) ++range.joint;
    links_.push_back(range);
  }
  AddPose("tool", robot.X_LT);
}

std::vector<std::string> ArmGeometry::Names() const {
  std::vector<std::string> names;
  for (const int k : parameters_) names.push_back(steps_[k].name);
  return names;
}

std::vector<std::string> ArmGeometry::Units() const {
  std::vector<std::string> units;
  for (const int k : parameters_) {
    units.push_back(steps_[k].kind == Kind::kRotation ? "rad" : "m");
  }
  return units;
}

Eigen::VectorXd ArmGeometry::Values() const {
  Eigen::VectorXd values(size());
  for (int k = 0; k < size(); ++k) values[k] = steps_[parameters_[k]].value;
  return values;
}

void ArmGeometry::SetValues(const Eigen::VectorXd& values) {
  CHECK_EQ(values.size(), size());
  for (int k = 0; k < size(); ++k) steps_[parameters_[k]].value = values[k];
}

Isometry3d ArmGeometry::ToolPose(const Eigen::VectorXd& q, const double* values,
                                 std::vector<ParameterTwist>* twists,
                                 std::vector<ParameterTwist>* joints) const {
  CHECK(parents_.empty());
  if (twists != nullptr) twists->clear();
  if (joints != nullptr) joints->clear();
  Isometry3d X = Isometry3d::Identity();
  for (const ElementaryTransform& step : steps_) {
    std::vector<ParameterTwist>* const own = step.parameter >= 0 ? twists
                                             : step.joint >= 0   ? joints
                                                                 : nullptr;
    if (own != nullptr) {
      own->push_back({X.linear().col(step.axis), X.translation(),
                      step.kind == Kind::kRotation});
    }
    double amount = step.parameter >= 0 ? values[step.parameter] : step.value;
    if (step.joint >= 0) amount += q[step.joint];
    step.Append(amount, &X);
  }
  return X;
}

// Of steps [begin, end) from the frame of `link` on; those behind a joint end
// at the frame of its link.
void ArmGeometry::AddCarriedTwists(int begin, int end, int link, int next,
                                   std::vector<CarriedTwist>* twists) const {
  const bool leads_to_link =
      begin > base_end_ && steps_[begin - 1].joint == link;
  Isometry3d X = Isometry3d::Identity();
  if (begin == 0 || leads_to_link) X = Product(steps_, begin, end).inverse();
  for (int k = begin; k < end; ++k) {
    const ElementaryTransform& step = steps_[k];
    if (step.parameter >= 0) {
      twists->push_back({link,
                         leads_to_link,
                         {X.linear().col(step.axis), X.translation(),
                          step.kind == Kind::kRotation},
                         next});
    }
    step.Append(step.value, &X);
  }
}

std::vector<CarriedTwist> ArmGeometry::CarriedTwists() const {
  std::vector<CarriedTwist> twists;
  AddCarriedTwists(0, base_end_, -1, -1, &twists);
  for (int i = 0; i < static_cast<int>(links_.size()); ++i) {
    AddCarriedTwists(links_[i].begin, links_[i].joint, ParentOf(parents_, i), i,
                     &twists);
    AddCarriedTwists(links_[i].joint + 1, links_[i].end, i, -1, &twists);
  }
  AddCarriedTwists(links_.back().end, static_cast<int>(steps_.size()),
                   static_cast<int>(links_.size()) - 1, -1, &twists);
  return twists;
}

Robot ArmGeometry::ApplyTo(const Robot& robot) const {
  CHECK_EQ(robot.links.size(), links_.size());
  Robot result = robot;
  for (size_t i = 0; i < links_.size(); ++i) {
    const LinkSteps& range = links_[i];
    result.links[i].X_PF = Product(steps_, range.begin, range.joint);
    result.links[i].X_ML = Product(steps_, range.joint + 1, range.end);
  }
  result.X_LT =
      Product(steps_, links_.back().end, static_cast<int>(steps_.size()));
  const Isometry3d X_WB = Product(steps_, 0, base_end_);
  result.gravity = X_WB.linear().transpose() * robot.gravity;
  return result;
}

}  // namespace armcal
