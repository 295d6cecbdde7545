#include "model/dynamics/deflected_links.h"

#include <iterator>
#include <utility>

#include "model/dynamics/flanked_spring.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
                       std::vector<Deflection> deflections) {
  const int samples = motion.size();
  DeflectedLinks links;
  MotionColumns behind(motion.q, motion.qd, motion.qdd, MatrixXd());
  std::vector<MatrixXd> moved(deflections.size(), MatrixXd(samples, 3));
  for (size_t i = 0; i < deflections.size(); ++i) {
    const int j = (*arm.transmissions)[i].joint;
    links.joints.push_back(j);
    const auto behind_motor = [&](int k, const VectorXd& by,
                                  std::vector<const double*>* of_joints) {
      moved[i].col(k) =
          Eigen::Map<const VectorXd>((*of_joints)[j], samples) - by;
      (*of_joints)[j] = moved[i].col(k).data();
    };
    behind_motor(0, deflections[i].angle, &behind.q);
    behind_motor(1, deflections[i].rate, &behind.qd);
    behind_motor(2, deflections[i].acceleration, &behind.qdd);
  }
  links.change = LinkTorque(*arm.robot, behind, samples);
  links.change -= *arm.load;
  links.deflections = std::move(deflections);
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
  std::vector<Deflection> deflections = FollowDeflections(joints, motion.dt);
  std::vector<std::shared_ptr<const DeflectedLinks>> links(arms.size());
  for (size_t i = 0; i < arms.size(); ++i) {
    if (like[i] < i) {
      links[i] = links[like[i]];
      continue;
    }
    const auto own = std::make_move_iterator(deflections.begin() +
                                             static_cast<long>(first_joint[i]));
    const auto count = static_cast<long>(arms[i].transmissions->size());
    links[i] = std::make_shared<const DeflectedLinks>(
        LinksAt(arms[i], motion, {own, own + count}));
  }
  return links;
}

}  // namespace armcal
