#include "model/dynamics/deflected_links.h"

#include <utility>

#include "model/dynamics/deflection.h"
#include "model/dynamics/flanked_spring.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Whether two transmissions deflect alike under the same load. Of laws other
// than springs between flanks nobody knows; these start where their spring
// rests under the first loads.
bool SameSpring(const Transmission& a, const Transmission& b,
                const MatrixXd& load) {
  const auto* x = a.torque.target<FlankedSpring>();
  const auto* y = b.torque.target<FlankedSpring>();
  if (x == nullptr || y == nullptr || a.joint != b.joint) return false;
  const auto start = [&](const Transmission& law, Eigen::Index k) {
    return law.initial_deflection ? law.initial_deflection(load(k, law.joint))
                                  : 0;
  };
  const Eigen::Index next = load.rows() > 1 ? 1 : 0;
  return x->gap == y->gap && x->stiffness == y->stiffness &&
         x->damping == y->damping && x->stiffening == y->stiffening &&
         a.stiffest == b.stiffest && start(a, 0) == start(b, 0) &&
         start(a, next) == start(b, next);
}

bool SameAnswer(const LinksBehindDrives& a, const LinksBehindDrives& b) {
  if (a.load != b.load || a.transmissions->size() != b.transmissions->size()) {
    return false;
  }
  for (size_t i = 0; i < a.transmissions->size(); ++i) {
    if (!SameSpring((*a.transmissions)[i], (*b.transmissions)[i], *a.load)) {
      return false;
    }
  }
  return true;
}

// The links' torque where deflections have put them, less the load. All but the
// deflected joints' columns are the motors'.
DeflectedLinks LinksAt(const LinksBehindDrives& arm, const Motion& motion,
                       const Deflection* deflections) {
  const int n = motion.num_joints(), samples = motion.size();
  DeflectedLinks links = {MatrixXd(), MatrixXd::Zero(n, samples),
                          MatrixXd::Zero(n, samples)};
  Motion behind;
  behind.dt = motion.dt;
  behind.q = motion.q;
  behind.qd = motion.qd;
  behind.qdd = motion.qdd;
  for (size_t i = 0; i < arm.transmissions->size(); ++i) {
    const int j = (*arm.transmissions)[i].joint;
    behind.q.col(j) -= deflections[i].angle;
    behind.qd.col(j) -= deflections[i].rate;
    behind.qdd.col(j) -= deflections[i].acceleration;
    links.deflection.row(j) += deflections[i].angle;
    links.deflection_rate.row(j) += deflections[i].rate;
  }
  links.change = LinkTorque(*arm.robot, behind) - *arm.load;
  return links;
}

}  // namespace

std::vector<std::shared_ptr<const DeflectedLinks>> FollowLinks(
    const std::vector<LinksBehindDrives>& arms, const Motion& motion,
    const LinkTorqueSlopes& slopes) {
  std::vector<DeflectedJoint> joints;
  std::vector<size_t> first_joint(arms.size()), like(arms.size());
  for (size_t i = 0; i < arms.size(); ++i) {
    like[i] = 0;
    while (like[i] < i && !SameAnswer(arms[like[i]], arms[i])) ++like[i];
    if (like[i] < i) continue;
    first_joint[i] = joints.size();
    for (const Transmission& law : *arms[i].transmissions) {
      const int j = law.joint;
      joints.push_back({&law, arms[i].load->col(j), slopes.stiffness.col(j),
                        slopes.damping.col(j), slopes.inertia.col(j)});
    }
  }
  const std::vector<Deflection> deflections =
      FollowDeflections(joints, motion.dt);
  std::vector<std::shared_ptr<const DeflectedLinks>> links(arms.size());
  for (size_t i = 0; i < arms.size(); ++i) {
    links[i] = like[i] < i
                   ? links[like[i]]
                   : std::make_shared<const DeflectedLinks>(LinksAt(
                         arms[i], motion, &deflections[first_joint[i]]));
  }
  return links;
}

}  // namespace armcal
