#include "model/plant/simulator_layout.h"

namespace armcal {

namespace {

template <class Law>
int NumStates(const Law& law) {
  return static_cast<int>(law.initial_state.size());
}
int NumStates(const WrenchLaw& law) { return law.num_states; }

template <class Laws>
int Place(const Laws& laws, int* size) {
  const int begin = *size;
  for (const auto& law : laws) *size += NumStates(law);
  return begin;
}

template <class Laws>
void Fill(const Laws& laws, int at, Eigen::VectorXd* x) {
  for (const auto& law : laws) {
    x->segment(at, NumStates(law)) = law.initial_state;
    at += NumStates(law);
  }
}

}  // namespace

SimulatorLayout::SimulatorLayout(const SimulatedRobot& robot) {
  const int n = robot.robot.num_joints();
  size = 2 * n;
  motors = size;
  size += 2 * static_cast<int>(robot.transmissions.size());
  joint_laws = Place(robot.joint_laws, &size);
  transmissions = Place(robot.transmissions, &size);
  wrenches = Place(robot.wrenches, &size);
  actuators = Place(robot.actuators, &size);
  temperature = size;
  size += n;
}

Eigen::VectorXd SimulatorLayout::StateAtRest(const SimulatedRobot& robot,
                                             const Eigen::VectorXd& q0,
                                             const ArmTerms& terms) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  x.head(q0.size()) = q0;
  for (size_t k = 0; k < robot.transmissions.size(); ++k) {
    const Transmission& law = robot.transmissions[k];
    x[motors + 2 * k] = q0[law.joint];
    if (law.initial_deflection) {
      x[motors + 2 * k] += law.initial_deflection(terms.bias[law.joint]);
    }
  }
  Fill(robot.joint_laws, joint_laws, &x);
  Fill(robot.transmissions, transmissions, &x);
  Fill(robot.actuators, actuators, &x);
  int at = wrenches;
  for (size_t k = 0; k < robot.wrenches.size(); ++k) {
    const WrenchLaw& law = robot.wrenches[k];
    if (law.num_states == 0) continue;
    x.segment(at, law.num_states) = law.initial_state(terms.points[k].X_WP);
    at += law.num_states;
  }
  return x;
}

}  // namespace armcal
