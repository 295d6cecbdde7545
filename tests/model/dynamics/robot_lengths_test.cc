#include "model/dynamics/robot_lengths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/model_parameters.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/urdf_skeleton.h"
#include "tests/fixtures/urdf_text.h"

namespace armcal::robot_lengths_test {

using namespace urdf_text;

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Lengths of the arm, each with a value drawn at random: other signs too.
std::vector<Length> RandomLengths(const Robot& robot, std::mt19937_64* random) {
  std::vector<Length> lengths = MakeProximalChain(robot).lengths;
  for (Length& length : lengths) length.value = Uniform(random, -1, 1);
  return lengths;
}

// The chain has the lengths, and nothing else of it changed.
void ExpectLengthsAlone(const Robot& robot, const std::vector<Length>& wished) {
  const ProximalChain before = MakeProximalChain(robot);
  const ProximalChain after = MakeProximalChain(WithLengths(robot, wished));
  std::vector<Vector3d> p;
  for (const ProximalJoint& joint : before.joints) {
    p.push_back(joint.X_JG.translation());
  }
  for (const Length& l : wished) p[l.next][l.component] = l.value;
  EXPECT_EQ(after.gravity, before.gravity);
  for (size_t i = 0; i < p.size(); ++i) {
    SCOPED_TRACE(robot.links[i].name);
    const ProximalJoint& a = after.joints[i];
    const ProximalJoint& b = before.joints[i];
    EXPECT_LT((a.X_JG.translation() - p[i]).norm(), 1e-12);
    EXPECT_LT((a.X_JG.linear() - b.X_JG.linear()).norm(), 1e-12);
    EXPECT_LT(std::abs(std::remainder(a.theta - b.theta, 2 * M_PI)), 1e-12);
    EXPECT_LT((a.X_JL.linear() - b.X_JL.linear()).norm(), 1e-12);
  }
}

void ExpectEachAndAll(const Robot& robot, std::mt19937_64* random) {
  const std::vector<Length> lengths = RandomLengths(robot, random);
  ExpectLengthsAlone(robot, lengths);
  for (const Length& length : lengths) {
    SCOPED_TRACE(length.owner_name);
    ExpectLengthsAlone(robot, {length});
  }
  ExpectLengthsAlone(robot, {});
}

// Rows with every number drawn at random.
Robot RandomTable(DhConvention convention, int n, std::mt19937_64* random,
                  std::vector<DhParameters>* rows) {
  Robot robot;
  robot.dh_convention = convention;
  rows->clear();
  for (int i = 0; i < n; ++i) {
    const VectorXd v = UniformVector(random, 4, -1, 1);
    rows->push_back({v[0], v[1], 1.5 * v[2], 3 * v[3]});
    Link link;
    link.name = "link" + std::to_string(i + 1);
    if (i == 1) link.joint.type = JointType::kPrismatic;
    SetDhPose(rows->back(), convention, &link);
    robot.links.push_back(link);
  }
  SetRandomInertials(random, &robot);
  return robot;
}

TEST(RobotLengths, OfSampleRobots) {
  std::mt19937_64 random(1);
  for (const std::string& name : SampleRobotNames()) {
    SCOPED_TRACE(name);
    ExpectEachAndAll(SampleRobot(name), &random);
  }
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    ExpectEachAndAll(RandomArm(2 + trial % 5, &random), &random);
  }
}

// The poses are those of the table with the numbers in it.
TEST(RobotLengths, AreTheNumbersOfTheTable) {
  std::mt19937_64 random(2);
  for (const auto convention :
       {DhConvention::kStandard, DhConvention::kModified}) {
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<DhParameters> rows;
      const Robot robot = RandomTable(convention, 4, &random, &rows);
      ExpectEachAndAll(robot, &random);
      const std::vector<Length> lengths = RandomLengths(robot, &random);
      Robot expected = robot;
      for (const Length& length : lengths) {
        for (size_t i = 0; i < rows.size(); ++i) {
          const std::string& name = robot.links[i].name;
          if (length.owner_name == name + ".a") rows[i].a = length.value;
          if (length.owner_name == name + ".d") rows[i].d = length.value;
        }
      }
      const Robot moved = WithLengths(robot, lengths);
      for (size_t i = 0; i < rows.size(); ++i) {
        SetDhPose(rows[i], convention, &expected.links[i]);
        const Link& a = moved.links[i];
        const Link& b = expected.links[i];
        EXPECT_LT((a.X_PF.matrix() - b.X_PF.matrix()).norm(), 1e-12) << i;
        EXPECT_LT((a.X_ML.matrix() - b.X_ML.matrix()).norm(), 1e-12) << i;
        EXPECT_EQ(a.inertial.ToVector(), b.inertial.ToVector());
      }
    }
  }
}

// Axes anywhere: link frames that have nothing to do with the lengths.
TEST(RobotLengths, OfUrdfRobots) {
  std::mt19937_64 random(3);
  RobotReaderOptions to_wrist;
  to_wrist.tip = "wrist";
  const std::string path = TempPath();
  std::ofstream(path) << kFile;
  const Robot odd = ReadUrdf(path, to_wrist);
  std::remove(path.c_str());
  ASSERT_FALSE(odd.dh_convention);
  ExpectEachAndAll(odd, &random);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<DhParameters> rows;
    Robot robot = RandomTable(DhConvention::kStandard, 4, &random, &rows);
    robot.dh_convention.reset();
    for (int i = 0; i < 4; ++i) {  // frames of links and joints anywhere
      Isometry3d X = Isometry3d::Identity();
      X.linear() = RotationFromRpy(UniformVector(&random, 3, -3, 3));
      X.translation() = UniformVector(&random, 3, -.5, .5);
      robot.links[i].X_ML = robot.links[i].X_ML * X;
      if (i < 3) robot.links[i + 1].X_PF = X.inverse();
    }
    ExpectEachAndAll(robot, &random);
    const Robot moved = WithLengths(robot, RandomLengths(robot, &random));
    for (int i = 0; i < 4; ++i) {  // the links' own frames stay on their axes
      EXPECT_EQ(moved.links[i].X_ML.matrix(), robot.links[i].X_ML.matrix());
    }
  }
}

// Parallel axes of a URDF: a is their distance, d counts into the next joint.
TEST(RobotLengths, OfParallelUrdfAxes) {
  const std::string joint = "<axis xyz='0 0 1'/><origin xyz='.24 .32 .2'/>";
  const Robot robot = Read(
      LinkXml("base") + LinkXml("upper") + LinkXml("fore") + LinkXml("hand") +
      JointXml("j1", "continuous", "base", "upper", joint) +
      JointXml("j2", "continuous", "upper", "fore", joint) +
      JointXml("j3", "continuous", "fore", "hand", joint));
  ExpectLengthsAlone(robot, {{0, 1, 0, .7, "a1", "upper.a"}});
  const Robot moved = WithLengths(robot, {{0, 1, 0, .7, "a1", "upper.a"},
                                          {1, 2, 0, .1, "a2", "fore.a"},
                                          {1, 2, 2, .3, "d2", "fore.d"}});
  // p_PF of j2 and j3, by hand: at q = 0 all frames are parallel.
  EXPECT_LT((moved.links[1].X_PF.translation() - Vector3d(.42, .56, .2)).norm(),
            1e-12);
  EXPECT_LT((moved.links[2].X_PF.translation() - Vector3d(.06, .08, .5)).norm(),
            1e-12);
}

// Torques of the arm that was moved are those of the model parameters of the
// first arm's structure with the lengths among them.
TEST(RobotLengths, TorquesFollowTheLinearModel) {
  std::mt19937_64 random(5);
  ModelParameters::Options options;
  options.geometry = GeometryKnowledge::kAllLengths;
  for (const auto convention :
       {DhConvention::kStandard, DhConvention::kModified}) {
    std::vector<DhParameters> rows;
    const Robot robot = RandomTable(convention, 4, &random, &rows);
    const ModelParameters parameters(robot, options);
    const Robot moved = WithLengths(robot, RandomLengths(robot, &random));
    const VectorXd x = parameters.Values(moved);
    Regressor regressor = parameters.MakeRegressor();
    Eigen::MatrixXd U;
    for (int sample = 0; sample < 20; ++sample) {
      const VectorXd q = UniformVector(&random, 4, -3, 3);
      const VectorXd qd = UniformVector(&random, 4, -2, 2);
      const VectorXd qdd = UniformVector(&random, 4, -2, 2);
      const VectorXd tau = InverseDynamics(moved, q, qd, qdd);
      regressor.Differential(q, qd, qdd, {}, &U);
      EXPECT_LT((U * x - tau).norm(), 1e-11 * tau.norm());
      EXPECT_GT((tau - InverseDynamics(robot, q, qd, qdd)).norm(),
                1e-3 * tau.norm());
    }
  }
}

}  // namespace armcal::robot_lengths_test
