#include "calib/linear/identifiability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/linear/solution.h"
#include "problems/identification_rows.h"
#include "problems/make_rows.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::identifiability_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rows of a log, their factor and what it is judged by.
struct Case {
  Case(const Robot& robot, GeometryKnowledge geometry, const Log& log_in,
       const RowOptions& rows)
      : log(log_in),
        parameters(robot, OptionsFor(geometry)),
        factor(parameters) {
    if (log.tau.size() == 0) AddTorque(robot, &log);
    const Trajectory trajectory = MakeTrajectory(log);
    MotionRegressor regressor(parameters);
    ForEachRow(trajectory, rows, &regressor, [&](const IdentificationRow& row) {
      U.push_back(row.U);
      Y.push_back(row.Y);
      for (int i = 0; i < parameters.num_joints(); ++i) {
        factor.Add(i, row.U.row(i), row.Y[i]);
      }
    });
  }
  static ModelParameters::Options OptionsFor(GeometryKnowledge geometry) {
    ModelParameters::Options options;
    options.geometry = geometry;
    return options;
  }
  Identifiability Analyze(double relative_noise, double unit = 1) const {
    return AnalyzeIdentifiability(
        factor, parameters, relative_noise * RightSideRms(factor), Scale(unit));
  }
  ReferenceScale Scale(double unit) const {
    return MakeReferenceScale(parameters, 1, .5, unit, RightSideRms(factor),
                              VectorXd::Zero(parameters.size()));
  }
  // The largest entry that direction x makes in the equations of joint i, or of
  // all joints (-1), relative to a typical parameter vector's.
  double Seen(const VectorXd& x, int i) const {
    double seen = 0, typical = 0;
    for (const MatrixXd& u : U) {
      const auto rows = i < 0 ? u : u.middleRows(i, 1);
      seen = std::max(seen, (rows * x).cwiseAbs().maxCoeff());
      typical =
          std::max(typical, (rows * x.asDiagonal()).cwiseAbs().maxCoeff());
    }
    return seen / std::max(typical, 1e-3);
  }

  Log log;
  ModelParameters parameters;
  BlockTriangularFactor factor;
  std::vector<MatrixXd> U;
  std::vector<VectorXd> Y;
};

RowOptions Differential() {
  RowOptions rows;
  rows.identification = Identification::kDifferential;
  return rows;
}
RowOptions Simpson(const std::vector<TimeRange>& intervals) {
  RowOptions rows;
  rows.identification = Identification::kIntegral;
  rows.intervals = intervals;
  rows.quadrature = Quadrature::kSimpson;
  return rows;
}

// A PUMA of which joints 2 and 3 only move.
Log PumaLog(const std::vector<int>& active) {
  std::mt19937_64 random(5);
  Multisine motion = RandomMultisine(&random, 6);
  motion.offset << .2, -.5, .4, .3, .6, -.2;
  for (int j = 0; j < 6; ++j) {
    if (std::count(active.begin(), active.end(), j) == 0) {
      motion.amplitude.row(j).setZero();
    }
  }
  return RecordMotion(motion, 6, .01);
}

Robot Puma() {
  Robot robot = SampleRobot("PUMA560 6R");
  std::mt19937_64 random(3);
  SetRandomInertials(&random, &robot);
  return robot;
}

TEST(Identifiability, PumaWithTwoJointsMoving) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({1, 2}),
               Differential());
  const Identifiability found = c.Analyze(1e-7);
  EXPECT_EQ(found.block_size, (std::vector<int>{1, 7, 7, 7, 7, 7}));
  EXPECT_EQ(found.block_rank, (std::vector<int>{0, 3, 3, 3, 4, 4}));
  EXPECT_EQ(found.batch_rank, 21);
  EXPECT_EQ(found.total, 36);
  EXPECT_FALSE(found.blocks_full());
  ASSERT_EQ(found.directions.size(), 15u);
  ASSERT_EQ(found.block_directions.size(), 19u);
}

TEST(Identifiability, DirectionsAreNull) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({1, 2}),
               Differential());
  const Identifiability found = c.Analyze(1e-7);
  MatrixXd N(36, found.directions.size());
  for (size_t k = 0; k < found.directions.size(); ++k) {
    const UnidentifiableDirection& d = found.directions[k];
    EXPECT_LT(c.Seen(d.x, -1), 1e-9) << d.text;
    EXPECT_DOUBLE_EQ(d.x.cwiseAbs().maxCoeff(), 1);
    EXPECT_EQ(d.block, -1);
    N.col(k) = d.x;
  }
  EXPECT_EQ(N.colPivHouseholderQr().rank(), N.cols());
  for (const UnidentifiableDirection& d : found.block_directions) {
    EXPECT_LT(c.Seen(d.x, d.block), 1e-9) << d.text;
    const int begin = c.parameters.block_begin(d.block);
    EXPECT_EQ(d.x.head(begin).norm(), 0);
    EXPECT_EQ(d.x.tail(36 - begin - c.parameters.block_size(d.block)).norm(),
              0);
  }
}

// In units in which joints' torques and parameters' columns are so much larger.
Identifiability InUnits(const Case& c, const VectorXd& joints,
                        const VectorXd& columns) {
  BlockTriangularFactor factor(c.parameters);
  for (size_t k = 0; k < c.U.size(); ++k) {
    for (int i = 0; i < 6; ++i) {
      factor.Add(i, joints[i] * c.U[k].row(i) * columns.asDiagonal(),
                 joints[i] * c.Y[k][i]);
    }
  }
  const VectorXd rms = RightSideRms(factor);
  ReferenceScale scale = c.Scale(1);
  scale.columns = joints.asDiagonal() * scale.columns * columns.asDiagonal();
  scale.torque = joints.cwiseProduct(scale.torque);
  return AnalyzeIdentifiability(factor, c.parameters, 1e-7 * rms, scale);
}

// Torques of one joint in units a million times as large or small, or any
// parameters in such units.
TEST(Identifiability, RanksDoNotDependOnUnits) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({1, 2}),
               Differential());
  std::mt19937_64 random(8);
  for (const double unit : {1e-6, 1e6}) {
    for (int j = 0; j < 7; ++j) {
      VectorXd joints = VectorXd::Ones(6), columns = VectorXd::Ones(36);
      if (j < 6) {
        joints[j] = unit;
      } else {
        for (double& x : columns) x = random() % 2 == 0 ? unit : 1;
      }
      const Identifiability found = InUnits(c, joints, columns);
      EXPECT_EQ(found.block_rank, (std::vector<int>{0, 3, 3, 3, 4, 4})) << j;
      EXPECT_EQ(found.batch_rank, 21) << "unit " << unit << " of " << j;
    }
  }
}

// Arms of a micrometre and of a thousand kilometres, of a milligram and of a
// thousand tons, where gravity grows with length: the same but for units.
TEST(Identifiability, RanksDoNotDependOnTheArmsSize) {
  for (const double length : {1e-6, 1e6}) {
    for (const double mass : {1e-6, 1e6}) {
      Robot robot = Puma();
      robot.gravity *= length;
      for (Link& link : robot.links) {
        link.X_PF.translation() *= length;
        link.X_ML.translation() *= length;
        link.inertial.mass *= mass;
        link.inertial.first_moment *= mass * length;
        link.inertial.inertia *= mass * length * length;
      }
      const Case c(robot, GeometryKnowledge::kKnown, PumaLog({1, 2}),
                   Differential());
      const Identifiability found = c.Analyze(1e-7);
      EXPECT_EQ(found.block_rank, (std::vector<int>{0, 3, 3, 3, 4, 4}));
      EXPECT_EQ(found.batch_rank, 21) << length << " m, " << mass << " kg";
    }
  }
}

TEST(Identifiability, PumaWithAllJointsMoving) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({0, 1, 2, 3, 4, 5}),
               Differential());
  const Identifiability found = c.Analyze(1e-3);
  EXPECT_TRUE(found.blocks_full());
  EXPECT_EQ(found.batch_rank, 36);
  EXPECT_TRUE(found.directions.empty());
}

// More noise makes directions unseen, never seen.
TEST(Identifiability, FallsWithNoise) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({0, 1, 2, 3, 4, 5}),
               Differential());
  int last = 36;
  for (const double noise : {1e-6, 1e-2, 1., 1e1, 1e2, 1e3, 1e4}) {
    const int rank = c.Analyze(noise).batch_rank;
    EXPECT_LE(rank, last) << noise;
    last = rank;
  }
  EXPECT_EQ(last, 0);
}

TEST(Identifiability, JointsWithoutEquationsHaveNoRank) {
  const Case c(Puma(), GeometryKnowledge::kKnown, PumaLog({0, 1, 2, 3, 4, 5}),
               Differential());
  const VectorXd rms = RightSideRms(c.factor);
  VectorXd noise = 1e-3 * rms;
  noise[0] = 0;
  const Identifiability found = AnalyzeIdentifiability(
      c.factor, c.parameters, noise,
      MakeReferenceScale(c.parameters, 1, .5, 1, rms, VectorXd::Zero(36)));
  EXPECT_EQ(found.block_rank.front(), 0);
  EXPECT_EQ(found.batch_rank, 35);  // without Izz[1]
  EXPECT_EQ(found.directions[0].text, "Izz[1]");
}

Robot PaperScara() {
  Robot robot = SampleRobot("SCARA RRPR");
  for (const int i : {0, 2, 3}) robot.links[i].zero_inertials = {"hx", "hy"};
  return robot;
}

// A motion that is symmetric in time, with which some sets of intervals leave
// joint 2 without full rank.
Log ScaraLog() {
  const VectorXd w = Eigen::Vector4d(.5, 1, .5, 1) * M_PI;
  const VectorXd a = Eigen::Vector4d(.8, .6, .05, .7);
  Multisine motion;
  motion.offset = Eigen::Vector4d(0, .3, 0, 0) + a;
  motion.amplitude = -a;
  motion.omega = w;
  motion.phase = VectorXd::Constant(4, M_PI / 2);
  Log log = RecordMotion(motion, 4, .002);
  SetPaperScaraTorque(&log);
  return log;
}

void ExpectRefusedButBatchSolves(const std::vector<TimeRange>& intervals) {
  const Case c(PaperScara(), GeometryKnowledge::kNonzeroLengths, ScaraLog(),
               Simpson(intervals));
  const Identifiability found = c.Analyze(1e-6, .5);
  EXPECT_EQ(found.block_rank, (std::vector<int>{1, 2, 1, 1}));
  EXPECT_EQ(found.batch_rank, 6);
  const LinearSolution recursive = SolveRecursive(c.factor, found);
  EXPECT_FALSE(recursive.solved);
  EXPECT_EQ(recursive.refusal, "block 2 has rank 2 of 3");
  const VectorXd rms = RightSideRms(c.factor);
  const VectorXd x =
      SolveBatch(c.factor, MakeReferenceScale(c.parameters, 1, .5, .5, rms,
                                              VectorXd::Zero(6)))
          .x;
  EXPECT_LT((x - PaperScaraTruth()).cwiseAbs().maxCoeff(), 2e-9);
}

TEST(Identifiability, TimeSymmetricScaraIsRefusedButBatchSolves) {
  ExpectRefusedButBatchSolves({{1, 1.5}, {1.5, 2}, {2.5, 3}});
}

TEST(Identifiability, TwoIntervalsAreRefusedButBatchSolves) {
  ExpectRefusedButBatchSolves({{0, .5}, {.5, 1}});
}

// What a joint at rest hides is said of it, not in mixtures.
TEST(Identifiability, NamesTheParametersOfAJointAtRest) {
  Robot robot = SampleRobot("2R planar (vertical plane)");
  std::mt19937_64 random(5);
  SetRandomInertials(&random, &robot);
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kArmature};
  const ModelParameters parameters(robot, options);
  Regressor regressor = parameters.MakeRegressor();
  BlockTriangularFactor factor(parameters);
  MatrixXd U;
  for (int k = 0; k < 200; ++k) {
    VectorXd q = UniformVector(&random, 2, -3, 3);
    const Eigen::Vector2d qd(Uniform(&random, -2, 2), 0);
    const Eigen::Vector2d qdd(Uniform(&random, -2, 2), 0);
    regressor.Differential(q, qd, qdd, VectorXd(), &U);
    const VectorXd tau = U * parameters.Values(robot);
    for (int i = 0; i < 2; ++i) factor.Add(i, U.row(i), tau[i]);
  }
  const VectorXd rms = RightSideRms(factor);
  const Identifiability found = AnalyzeIdentifiability(
      factor, parameters, .01 * rms,
      MakeReferenceScale(parameters, 1, .5, 1, rms,
                         VectorXd::Zero(parameters.size())));
  std::vector<std::string> texts;
  for (const auto& d : found.directions) texts.push_back(d.text);
  EXPECT_THAT(texts, testing::ElementsAre("viscous[2]", "armature[2]"));
}

}  // namespace armcal::identifiability_test
