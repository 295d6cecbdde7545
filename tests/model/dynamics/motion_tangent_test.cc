#include "model/dynamics/motion_tangent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/batch_rollout.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::motion_tangent_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDuration = .12;  // s
constexpr int kSteps = 2;          // of a period, in simulation
constexpr JointTerm kTerms[] = {JointTerm::kViscous, JointTerm::kCoulomb,
                                JointTerm::kOffset, JointTerm::kArmature};

// All inertial parameters, then each joint's terms and width.
TangentParameters AllOf(int n) {
  TangentParameters all;
  for (int k = 0; k < 10 * n; ++k) all.inertials.push_back(k);
  for (int j = 0; j < n; ++j) {
    for (const JointTerm term : kTerms) all.terms.push_back({j, term});
    all.terms.push_back({j, {}});
  }
  return all;
}

RolloutArm Changed(RolloutArm arm, int parameter, double change) {
  const int n = arm.robot.num_joints();
  if (parameter < 10 * n) {
    InertialParameters& inertial = arm.robot.links[parameter / 10].inertial;
    Vector10d v = inertial.ToVector();
    v[parameter % 10] += change;
    inertial = InertialParameters::FromVector(v);
    return arm;
  }
  const int j = (parameter - 10 * n) / 5, term = (parameter - 10 * n) % 5;
  double* value = term == 4 ? &arm.transitions[j].width
                            : TermOf(kTerms[term], &arm.robot.links[j].joint);
  *value += change;
  return arm;
}

// Where the arm was at the periods' borders, rows, under a constant torque.
struct Borders {
  MatrixXd q, qd;
};
Borders Move(const RolloutArm& arm, const VectorXd& start,
             const VectorXd& torque, int periods) {
  const int n = static_cast<int>(start.size()) / 2;
  Borders borders{MatrixXd(periods + 1, n), MatrixXd(periods + 1, n)};
  RolloutStates states{
      start.head(n).transpose(), start.tail(n).transpose(), {}, {}};
  borders.q.row(0) = start.head(n);
  borders.qd.row(0) = start.tail(n);
  BatchRollout({arm}).Run(
      0, kDuration / periods / kSteps, static_cast<long>(periods) * kSteps,
      [&](const BatchRollout::Batch& at, double* begin, double* end) {
        for (int j = 0; j < n; ++j) {
          begin[j * at.stride] = end[j * at.stride] = torque[j];
        }
      },
      [&](const BatchRollout::Batch& at) {
        if (at.step % kSteps != 0) return;
        for (int j = 0; j < n; ++j) {
          borders.q(at.step / kSteps, j) = at.q[j * at.stride];
          borders.qd(at.step / kSteps, j) = at.qd[j * at.stride];
        }
      },
      &states);
  return borders;
}

class MotionTangentTest : public testing::TestWithParam<const simd::Kernels*> {
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, MotionTangentTest,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

// By parameters, start (q, qd) and torque, of where the arm ends.
MatrixXd Tangents(const RolloutArm& arm, const VectorXd& start,
                  const VectorXd& torque, int periods,
                  const simd::Kernels& kernels) {
  const int n = static_cast<int>(torque.size()), p = 15 * n;
  const Borders at = Move(arm, start, torque, periods);
  MotionTangent tangent(arm, AllOf(n), kernels);
  EXPECT_EQ(tangent.num_parameters(), p);
  tangent.Linearise(at.q, at.qd, 0, periods, kDuration / periods);
  TangentRows state(2 * n, p + 3 * n), by_torque(n, p + 3 * n);
  for (int k = 0; k < 2 * n; ++k) state(k, p + k) = 1;
  for (int j = 0; j < n; ++j) by_torque(j, p + 2 * n + j) = 1;
  for (int k = 0; k < periods; ++k) {
    tangent.Advance(k, by_torque, true, &state);
  }
  MatrixXd all(2 * n, p + 3 * n);
  for (int r = 0; r < 2 * n; ++r) {
    for (int c = 0; c < all.cols(); ++c) all(r, c) = state(r, c);
  }
  return all;
}

// The same by differences of order 4.
MatrixXd Differences(const RolloutArm& arm, const VectorXd& start,
                     const VectorXd& torque) {
  constexpr double h = 1e-3;
  constexpr int kPeriods = 120;
  const int n = static_cast<int>(torque.size()), p = 15 * n;
  MatrixXd slopes(2 * n, p + 3 * n);
  for (int c = 0; c < slopes.cols(); ++c) {
    const auto end_at = [&](double change) {
      VectorXd start_at = start, torque_at = torque;
      if (c >= p + 2 * n) {
        torque_at[c - p - 2 * n] += change;
      } else if (c >= p) {
        start_at[c - p] += change;
      }
      const Borders at = Move(c < p ? Changed(arm, c, change) : arm, start_at,
                              torque_at, kPeriods);
      VectorXd end(2 * n);
      end << at.q.row(kPeriods).transpose(), at.qd.row(kPeriods).transpose();
      return end;
    };
    slopes.col(c) =
        (8 * (end_at(h) - end_at(-h)) - (end_at(2 * h) - end_at(-2 * h))) /
        (12 * h);
  }
  return slopes;
}

// Arms of any joints and frames, every parameter, the start and the torque: to
// 0.2 % with periods of 1 ms, with half of that twice as near or nearer.
TEST_P(MotionTangentTest, IsTheDerivativeOfTheMotion) {
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
    const VectorXd start = UniformVector(&random, 2 * n, -1, 1);
    const VectorXd torque = UniformVector(&random, n, -5, 5);
    const MatrixXd slopes = Differences(arm, start, torque);
    const auto errors = [&](int periods) {
      const MatrixXd error =
          Tangents(arm, start, torque, periods, *GetParam()) - slopes;
      return VectorXd(
          error.cwiseAbs().colwise().maxCoeff().transpose().array() /
          slopes.cwiseAbs().colwise().maxCoeff().transpose().array().max(1e-3));
    };
    const VectorXd coarse = errors(120), fine = errors(240);
    EXPECT_LT(coarse.maxCoeff(), 2e-3) << n << " joints";
    EXPECT_GT(coarse.norm() / fine.norm(), n == 1 ? 3.5 : 1.9)
        << n << " joints";
  }
}

// A block on a slide with viscous friction, m v' = F - d v, by its closed form.
TEST_P(MotionTangentTest, SlidingBlock) {
  const double m = 2, d = 3, v0 = .4, F = 5, T = kDuration;
  Robot robot;
  Link link;
  link.joint.type = JointType::kPrismatic;
  link.joint.viscous = d;
  link.inertial.mass = m;
  robot.links = {link};
  robot.gravity.setZero();
  const RolloutArm arm{robot, std::vector<CoulombTransition>(1), {}};
  const MatrixXd end = Tangents(arm, Eigen::Vector2d(0, v0),
                                VectorXd::Constant(1, F), 120, *GetParam());
  const double decay = std::exp(-d * T / m);
  const int mass = 0, viscous = 10, offset = 12, qd = 16, torque = 17;
  EXPECT_NEAR(end(1, qd), decay, 1e-7);
  EXPECT_NEAR(end(1, torque), (1 - decay) / d, 1e-7);
  EXPECT_NEAR(end(1, offset), -(1 - decay) / d, 1e-7);
  EXPECT_NEAR(end(1, mass), (v0 - F / d) * decay * d * T / (m * m), 1e-6);
  EXPECT_NEAR(end(1, viscous),
              -F / (d * d) * (1 - decay) - (v0 - F / d) * decay * T / m, 1e-6);
}

}  // namespace armcal::motion_tangent_test
