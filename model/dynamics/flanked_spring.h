#pragma once

namespace armcal {

// The law of a transmission (simulated_robot.h): flanks that leave a gap
// between them, each a spring and a damper that press and never pull. Without a
// gap, of any size, it is a damper and a spring that may stiffen, stiffness d
// (1 + stiffening d^2), as harmonic drives do (Tuttle and Seering 1996). It is
// a class of its own so that whoever follows deflections knows it again
// (Transmission::torque.target) and follows many of them in lanes.
struct FlankedSpring {
  // Of the gap: a corner is a parabola over twice this much. That has to be
  // small beside what flanks yield by, 7 to 25 % of the gap
  // (effects/backlash): a flank is felt before it is reached, and with corners
  // that were rounded over .05 gaps were told a fifth too wide.
  static constexpr double kRounding = .005;

  double gap = 0;         // rad or m
  double stiffness = 0;   // N m/rad or N/m, of a flank
  double damping = 0;     // N m s/rad or N s/m, of a flank
  double stiffening = 0;  // 1/rad^2 or 1/m^2, without a gap only

  double operator()(double deflection, double rate, const double* = nullptr,
                    double* = nullptr) const;
};

}  // namespace armcal
