#pragma once

#include "model/dynamics/joint_controller.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"

namespace armcal {

// Whether the loop of `controller` (DriveKind::kPd) is stable about rest at
// each posture of the motion, 49 of them, with all of its gains `factor` times
// as large. Judged by the eigenvalues of one control period: the arm of mass
// matrix M (armature included, no friction) under a torque that is held,
//   q+ = q + T v + T^2/2 M^-1 tau,   v+ = v + T M^-1 tau,
// with the velocity filter and the integral of JointController.
bool IsStable(const Robot& robot, const ControllerOptions& controller,
              const ReferenceMotion& motion, double factor);

// DefaultController (kPd) at the motion's start, with gains that have a margin
// of 2 along the motion (Astrom and Murray, Feedback Systems, 2008, sec. 9.3,
// ask for 2 to 5).
//
// DefaultController takes a joint's inertia with the others held. While they
// are free to move with it, a joint of a light arm without motors' inertia has
// far less. Damping kd stays below what the sampled, filtered velocity of a
// single joint can damp if
//   largest eigenvalue of M^-1 diag(kd) <= limit / 2.
// As long as it is not, the joint with the largest part in that mode gets a
// fifth less of kp and kd. The integral is no faster than the joint's largest
// inertia m of the motion allows: a quarter, since others give way too, of
// Routh's bound for gains half as large, m ki / 2 < kp kd / 4.
ControllerOptions SteadyController(const Robot& robot,
                                   const ReferenceMotion& motion,
                                   double bandwidth_hz);

}  // namespace armcal
