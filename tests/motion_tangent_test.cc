#include "model/motion_tangent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/joint_term.h"
#include "tests/random_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 2e-3;  // s
constexpr int kSteps = 60;

// Values of MotionTangent's parameters.
VectorXd ParametersOf(const RolloutArm& arm) {
  const int n = arm.robot.num_joints();
  VectorXd x(15 * n);
  for (int j = 0; j < n; ++j) {
    x.segment<10>(10 * j) = arm.robot.links[j].inertial.ToVector();
    const Joint& joint = arm.robot.links[j].joint;
    x.segment<4>(10 * n + 4 * j) << joint.viscous, joint.coulomb, joint.offset,
        joint.armature;
    x[14 * n + j] = arm.transitions[j].width;
  }
  return x;
}

RolloutArm WithParameters(RolloutArm arm, const VectorXd& x) {
  const int n = arm.robot.num_joints();
  for (int j = 0; j < n; ++j) {
    arm.robot.links[j].inertial =
        InertialParameters::FromVector(x.segment<10>(10 * j));
    Joint& joint = arm.robot.links[j].joint;
    joint.viscous = x[10 * n + 4 * j];
    joint.coulomb = x[10 * n + 4 * j + 1];
    joint.offset = x[10 * n + 4 * j + 2];
    joint.armature = x[10 * n + 4 * j + 3];
    arm.transitions[j].width = x[14 * n + j];
  }
  return arm;
}

// Where the arm ends, (q, qd), under a torque of begin, middle and end.
VectorXd End(const RolloutArm& arm, const VectorXd& start,
             const MatrixXd& torque, StageMotion* kept,
             const simd::Kernels& kernels) {
  const long n = start.size() / 2;
  StageStepper stepper(arm, kernels);
  stepper.SetState(start.head(n), start.tail(n));
  for (int k = 0; k < kSteps; ++k) {
    EXPECT_TRUE(stepper.Advance(kStep, torque, 4 * k, kept));
  }
  VectorXd end(2 * n);
  end << stepper.q(), stepper.qd();
  return end;
}

class MotionTangentTest : public testing::TestWithParam<const simd::Kernels*> {
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, MotionTangentTest,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

// Against differences of the rollout itself, of order 4: arms of any joints
// and frames, every parameter, the start and the torque.
TEST_P(MotionTangentTest, IsTheDerivativeOfTheRollout) {
  std::mt19937_64 random(7);
  for (const int n : {1, 3, 6}) {
    RolloutArm arm{ArmWithFrames(n, n, &random), {}, {}};
    arm.transitions.resize(n);
    for (int j = 0; j < n; ++j) {
      Joint& joint = arm.robot.links[j].joint;
      joint.viscous = Uniform(&random, .1, .5);
      joint.coulomb = Uniform(&random, .1, .5);
      joint.offset = Uniform(&random, -1, 1);
      joint.armature = Uniform(&random, .5, 1);
      arm.transitions[j].width = Uniform(&random, .2, .4);
    }
    const VectorXd x = ParametersOf(arm);
    VectorXd start = UniformVector(&random, 2 * n, -1, 1);
    MatrixXd torque(n, 3);
    for (int k = 0; k < 3; ++k) {
      torque.col(k) = UniformVector(&random, n, -5, 5);
    }
    const int p = 15 * n, columns = p + 5 * n;
    StageMotion motion;
    motion.Resize(kSteps, n);
    End(arm, start, torque, &motion, *GetParam());
    MotionTangent tangent(arm, *GetParam());
    tangent.Linearise(motion, kSteps);
    TangentRows state(2 * n, columns), rows[3];
    for (int k = 0; k < 2 * n; ++k) state(k, p + k) = 1;
    for (int k = 0; k < 3; ++k) {
      rows[k] = TangentRows(n, columns);
      for (int j = 0; j < n; ++j) rows[k](j, p + (2 + k) * n + j) = 1;
    }
    const TangentRows* const by_torque[] = {&rows[0], &rows[1], &rows[2]};
    for (int k = 0; k < kSteps; ++k) {
      tangent.Advance(k, kStep, by_torque, true, &state);
    }
    const auto end_at = [&](int c, double change) {
      VectorXd x_at = x, start_at = start;
      MatrixXd torque_at = torque;
      if (c < p) {
        x_at[c] += change;
      } else if (c < p + 2 * n) {
        start_at[c - p] += change;
      } else {
        torque_at((c - p) % n, (c - p) / n - 2) += change;
      }
      return End(WithParameters(arm, x_at), start_at, torque_at, nullptr,
                 *GetParam());
    };
    for (int c = 0; c < columns; ++c) {
      const double h = 1e-3;
      const VectorXd slope = (8 * (end_at(c, h) - end_at(c, -h)) -
                              (end_at(c, 2 * h) - end_at(c, -2 * h))) /
                             (12 * h);
      const double scale = std::max(1e-3, slope.cwiseAbs().maxCoeff());
      for (int r = 0; r < 2 * n; ++r) {
        EXPECT_NEAR(state(r, c), slope[r], 2e-7 * scale)
            << n << " joints, row " << r << " column " << c;
      }
    }
  }
}

// A block on a slide with viscous friction, m v' = F - d v, by its closed form.
TEST_P(MotionTangentTest, SlidingBlock) {
  const double m = 2, d = 3, v0 = .4, F = 5, T = kSteps * kStep;
  Robot robot;
  Link link;
  link.joint.type = JointType::kPrismatic;
  link.joint.viscous = d;
  link.inertial.mass = m;
  robot.links = {link};
  robot.gravity.setZero();
  RolloutArm arm{robot, std::vector<CoulombTransition>(1), {}};
  StageMotion motion;
  motion.Resize(kSteps, 1);
  VectorXd start(2);
  start << 0, v0;
  const VectorXd end =
      End(arm, start, MatrixXd::Constant(1, 3, F), &motion, *GetParam());
  const double decay = std::exp(-d * T / m), v = F / d + (v0 - F / d) * decay;
  EXPECT_NEAR(end[1], v, 1e-11);
  MotionTangent tangent(arm, *GetParam());
  tangent.Linearise(motion, kSteps);
  TangentRows state(2, 16), none(1, 16);
  state(1, 15) = 1;
  const TangentRows* const torque[] = {&none, &none, &none};
  for (int k = 0; k < kSteps; ++k) {
    tangent.Advance(k, kStep, torque, true, &state);
  }
  const int mass = 0, viscous = 10, offset = 12;
  EXPECT_NEAR(state(1, 15), decay, 1e-11);
  EXPECT_NEAR(state(1, offset), -(1 - decay) / d, 1e-11);
  EXPECT_NEAR(state(1, mass), (v0 - F / d) * decay * d * T / (m * m), 1e-11);
  EXPECT_NEAR(state(1, viscous),
              -F / (d * d) * (1 - decay) - (v0 - F / d) * decay * T / m, 1e-11);
}

}  // namespace
}  // namespace armcal
