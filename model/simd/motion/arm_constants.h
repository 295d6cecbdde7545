#pragma once

namespace armcal::simd {

// An arm as forward dynamics sees it (model/dynamics/arm_plan.h makes it). Body
// i has a frame M with z along its joint's axis, which lies in the frame of the
// body before (W, turned about z, for the first) at p, turned by Rx(beta)
// Rz(angle + q); that of a prismatic joint does not turn with q and slides
// along its z. Any chain of joints has such frames: z-x-z Euler angles, whose
// last rotation is the joint's own and whose first that of the joint before.
//
// All of an arm's numbers may differ from lane to lane; how many joints it has
// and of what kind may not.
enum BodyConstant {
  kCosineBeta,
  kSineBeta,
  kAngle,
  kPosition,                         // p, three of them, m
  kFirstMoment = kPosition + 3,      // about Mo, in M, kg m
  kSecondMoment = kFirstMoment + 3,  // xx xy xz yy yz zz, integrals of r r' dm
  kMassOfBody = kSecondMoment + 6,   // kg
  kMassBeyond,                       // of this body and all after it
  // What the joint adds to its own torque.
  kArmatureOfJoint,
  kViscous,
  kCoulomb,
  kInverseWidth,  // of the Coulomb transition
  kOffset,
  kStiffness,  // of a spring, and where it is at rest
  kRest,
  kNumBodyConstants,
};

// How Coulomb friction passes through zero (model/dynamics/joint_term.h); kNone
// in a joint without it.
enum class Transition { kNone, kVelocity, kDisplacement };
// What all lanes have in common.
struct JointKind {
  bool rotational = true;
  bool has_spring = false;  // its stiffness may not be 0
  Transition transition = Transition::kNone;
};

struct ArmPath;
struct ArmConstants {
  int num_joints;
  const JointKind* joints;
  bool has_joint_terms;  // viscous or Coulomb friction or springs, anywhere
  // m/s^2 in the frame before the first body, three; then kNumBodyConstants of
  // each body. Each is a number per lane.
  const double* values;
  // Of an arm that branches: its bodies count as these chains', whose terms are
  // summed, and only what joints add is its own. Else none.
  int num_paths;
  const ArmPath* paths;
};

// A chain of the arm's joints, from the base to a tip. Its bodies have their
// mass where they are on no path before, and its joints nothing of their own.
struct ArmPath {
  ArmConstants chain;
  const int* joints;  // ascending
};

// Where the arm is; the numbers of joint j, one per lane, at j * stride.
struct ArmState {
  double* q;
  double* qd;
  double* coulomb;  // states of displacement laws; others are not touched
  long stride;
};

// What is computed for as many arms, or states of one, as there are `lanes`.
// Numbers of joint j, one per lane, lie at j * stride.
struct ArmKernels {
  int lanes;
  // M[(n i + j) * stride], without armature, and the torque that holds it at
  // (q, qd) without acceleration. Neither of the latter two may be given.
  void (*terms)(const ArmConstants& arm, const double* q, const double* qd,
                long stride, double* M, double* bias);
  // qdd from the torque, with armature and without other joint terms. NaN where
  // no inertia resists a joint.
  void (*acceleration)(const ArmConstants& arm, const double* q,
                       const double* qd, const double* tau, long stride,
                       double* qdd);
  // Advances by `step` s with a torque that is linear in between
  // (model/dynamics/batch_rollout.h). Returns a bit for each lane whose state
  // is no number any more, or beyond all use; it becomes 0.
  unsigned (*advance)(const ArmConstants& arm, double step,
                      const double* tau_begin, const double* tau_end,
                      const ArmState& state);
};

}  // namespace armcal::simd
