#include "calib/diagnose/candidates/corrected_robot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "calib/diagnose/data/thresholds.h"
#include "model/dynamics/forward_dynamics.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of the inertia that a joint moves: a motor so light that its link does not
// feel it, and not so light that it rings faster than can be simulated.
constexpr double kLightMotor = .02;

// A joint that yields between motor and link needs a mass on both sides. One
// without armature gets a motor of kLightMotor of the inertia that it moves in
// the middle of its range, so small that its link does not feel it and not so
// small that it rings beyond what can be simulated; `notes` says so.
void GiveMotors(const MotionScale& scale, CorrectedRobot* corrected) {
  Robot& robot = corrected->plant.robot;
  const VectorXd inertia =
      MassMatrix(robot, (scale.low + scale.high) / 2).diagonal();
  for (const Transmission& law : corrected->plant.transmissions) {
    Joint& joint = robot.links[law.joint].joint;
    if (joint.armature > 0) continue;
    joint.armature = kLightMotor * inertia[law.joint];
    char text[120];
    std::snprintf(text, sizeof(text),
                  "joint %s yields but has no armature: simulated with %.3g %s",
                  joint.name.c_str(), joint.armature,
                  IsRotational(joint.type) ? "kg m^2" : "kg");
    corrected->notes.push_back(text);
  }
}

// How much of the plant is not its robot.
size_t NumSlots(const SimulatedRobot& plant) {
  return plant.joint_laws.size() + plant.transmissions.size() +
         plant.wrenches.size() + plant.actuators.size() + plant.sensors.size() +
         plant.thermal.size() + (plant.clock ? 1 : 0) +
         (plant.torque_delay != 0 ? 1 : 0);
}

// An effect put into a plant, with what it says of itself. Whether it is in the
// robot alone (`in_robot`) is told by whether anything but the robot grew: a
// law, a wrench, a sensor, a delay.
CarriedEffect Carry(const EffectSite& site, const GapCandidate& found,
                    SimulatedRobot* plant) {
  const Effect& effect = *found.effect;
  const size_t slots = NumSlots(*plant);
  const double delay = plant->torque_delay;
  effect.apply(site, found.p, plant);
  CarriedEffect carried;
  carried.found = found;
  carried.estimates = EstimatesOf(effect, site, found.p);
  if (effect.numbers) carried.numbers = effect.numbers(site, found.p);
  carried.in_robot = NumSlots(*plant) == slots;
  carried.in_delay = plant->torque_delay != delay;
  return carried;
}

}  // namespace

void CorrectedRobot::AddDelay(double more) {
  delay += more;
  for (CarriedEffect& effect : effects) {
    effect.acts_late = effect.in_delay && acts_late();
  }
}

// The timing of torque against positions is free in every fit and ends at some
// tenths of a millisecond even where nothing is late. By itself it is believed
// as other numbers of the model are, from two standard deviations of what they
// may be off by on (Limits().far).
bool CorrectedRobot::has_delay() const {
  const bool named =
      std::any_of(effects.begin(), effects.end(),
                  [](const CarriedEffect& effect) { return effect.in_delay; });
  const double least =
      named ? kLeastDelay : Limits().far * BaselineOptions().timing_s;
  return std::abs(delay) >= least;
}

// The robot with the fitted numbers, the laws that the reference showed and the
// effects that were found, as something that can be simulated and written to a
// file. Friction is added last, with the mixture of widths that the fit found,
// since effects may have changed the joint's own Coulomb friction, and the
// delay of the torque is taken out of the plant, as only who replays a log
// knows whether a torque is given or recorded.
CorrectedRobot MakeCorrectedRobot(const GapBaseline& baseline,
                                  const VectorXd& x,
                                  const std::vector<GapCandidate>& effects,
                                  const MotionScale& scale) {
  CorrectedRobot corrected;
  corrected.delay = baseline.DelayAt(x);
  corrected.width = scale.width;
  corrected.scale = scale;
  const Robot fitted = baseline.With(x);
  corrected.plant.robot = fitted;
  for (const KnownEffect& known : baseline.KnownAt(x)) {
    GapCandidate effect;
    effect.effect = known.effect;
    effect.joint = known.joint;
    effect.p = known.p;
    corrected.effects.push_back(
        Carry({&fitted, known.joint, &baseline.known().scale()}, effect,
              &corrected.plant));
  }
  for (const GapCandidate& effect : effects) {
    corrected.effects.push_back(
        Carry({&fitted, effect.joint, &scale}, effect, &corrected.plant));
  }
  corrected.num_effect_laws =
      static_cast<int>(corrected.plant.joint_laws.size());
  // Who replays a log applies all of it.
  corrected.AddDelay(corrected.plant.torque_delay);
  corrected.plant.torque_delay = 0;
  for (int j = 0; j < fitted.num_joints(); ++j) {
    std::vector<CoulombPart> coulomb = baseline.CoulombAt(j, x);
    // Effects may have changed the joint's own friction.
    coulomb.front().force += corrected.plant.robot.links[j].joint.coulomb -
                             fitted.links[j].joint.coulomb;
    AddJointTerms(j, coulomb, &corrected.plant);
    corrected.coulomb.push_back(std::move(coulomb));
  }
  GiveMotors(scale, &corrected);
  return corrected;
}

}  // namespace armcal
