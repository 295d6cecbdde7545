#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace armcal {

// A force that grows evenly with x until it is `force` at `width`, and stays
// so: dry friction over velocity, a bounded spring over deflection. Every odd
// curve is nearly a sum of such parts; those where it bends upwards are of
// negative force (saturating_parts.h).
struct SaturatingPart {
  double force = 0;  // N m or N
  double width = 0;  // of x: rad/s or m/s, rad or m
};

// Bristles that bend before they slip (LuGre: Canudas de Wit et al. 1995,
// without damping of their own): force = stiffness z, z' = v - stiffness |v| z
// / g(v), g(v) = coulomb + (at_rest - coulomb) exp(-(v / stribeck_velocity)^2).
struct BristleFriction {
  double stiffness = 0;          // N m/rad or N/m
  double coulomb = 0;            // N m or N, of fast motion
  double at_rest = 0;            // N m or N
  double stribeck_velocity = 1;  // rad/s or m/s

  // What there is more of near standstill than in motion. The bristles give way
  // over what the joint moves in 10 ms at `width`, the velocity within which
  // friction changes sign: too little to be seen.
  static BristleFriction Stribeck(double at_rest, double velocity,
                                  double width) {
    return {at_rest / (.01 * width), 0, at_rest, velocity};
  }
};

// A torque of amplitude sin(harmonic q + phase) on the joint.
struct TorqueWave {
  double amplitude = 0;  // N m or N
  double harmonic = 0;   // 1/rad or 1/m
  double phase = 0;      // rad
};

// A spring that pushes towards `centre`, and the less stiffly the farther it is
// off: a cable that lies over to one side or the other.
struct BoundedSpring {
  double centre = 0;  // rad or m
  std::vector<SaturatingPart> parts;
};

// A motor drives its link over a spring and a damper: between flanks that leave
// a gap, or, without a gap, a spring of stiffness d (1 + stiffening d^2).
struct GearSpring {
  double gap = 0;         // rad or m
  double stiffness = 0;   // N m/rad or N/m
  double damping = 0;     // N m s/rad or N s/m
  double stiffening = 0;  // 1/rad^2 or 1/m^2
};

// What acts on a joint beside what a Joint has.
struct JointDrive {
  // A spring pushes with -stiffness (q - rest); N m/rad or N/m, rad or m.
  double stiffness = 0;
  double rest = 0;
  // Torque that the motor gives per torque that is asked of it.
  double gain = 1;
  // The largest torque that is given at rest, N m or N, and by how much it
  // falls with the speed along it, as a supply's voltage limits it, N m s/rad
  // or N s/m: at their ratio, the no-load speed, nothing is left.
  double torque_limit = std::numeric_limits<double>::infinity();
  double torque_limit_slope = 0;

  // Laws that few robot files have. With a gear between motor and link they
  // act on the motor, as do friction and spring.
  double quadratic = 0;  // of v |v|, N m s^2/rad^2 or N s^2/m^2
  // The joint's Coulomb friction with how it changes sign; empty: not known.
  std::vector<SaturatingPart> dry = {};
  std::vector<BristleFriction> bristles = {};
  std::vector<TorqueWave> waves = {};
  std::vector<BoundedSpring> bounded_springs = {};
  std::optional<GearSpring> gear = std::nullopt;

  bool HasLaws() const {
    return quadratic != 0 || !dry.empty() || !bristles.empty() ||
           !waves.empty() || !bounded_springs.empty() || gear;
  }
};

}  // namespace armcal
