#include "calib/diagnose/candidates/candidate_torques.h"

#include <glog/logging.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::candidate_torques_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Every effect of the catalogue at every joint, evaluated for a robot.
std::vector<GapCandidate> EvaluatedFor(const Robot& robot,
                                       const EffectArm& arm) {
  const GapBaseline baseline(robot, {},
                             VectorXd::Constant(robot.num_joints(), 10));
  const std::vector<GapSegment> segments = {
      MakeSegment(arm.motion, arm.Recorded().nominal())};
  GapRows rows(segments, 6);
  const MatrixXd none = MatrixXd::Zero(rows.num_thin(), robot.num_joints());
  rows.SetNoise(std::vector<Autoregression>(robot.num_joints()), none);
  std::vector<GapCandidate> candidates =
      ListCandidates(baseline, rows, arm.scale, none, {}, false);
  EvaluateCandidates(baseline, rows, arm.scale, RecordedTorques(baseline, rows),
                     &candidates);
  return candidates;
}

double Difference(const GapCandidate& a, const GapCandidate& b) {
  double difference = 0;
  for (size_t k = 0; k < a.torque.size(); ++k) {
    for (size_t j = 0; j < a.torque[k].size(); ++j) {
      if (a.torque[k][j].size() != b.torque[k][j].size()) return INFINITY;
      if (a.torque[k][j].size() == 0) continue;
      difference = std::max(
          difference, (a.torque[k][j] - b.torque[k][j]).cwiseAbs().maxCoeff());
    }
  }
  return difference;
}

// Of all effects there are: whatever is kept when the first joint's friction
// and armature are others is the same for that robot, and what is not kept is
// not all the same.
TEST(CandidateTorques, OfJointsWithTheSameTermsServeAnotherRobot) {
  const EffectArm arm("2R planar (vertical plane)", 20, .01);
  Robot other = arm.robot;
  other.links[0].joint.viscous = 0;
  other.links[0].joint.coulomb = .3;
  other.links[0].joint.armature = .1;
  const std::vector<GapCandidate> first = EvaluatedFor(arm.robot, arm);
  const std::vector<GapCandidate> second = EvaluatedFor(other, arm);
  ASSERT_EQ(first.size(), second.size());
  const auto kept = WithSameTorques(arm.robot, other, arm.scale, first);
  EXPECT_GT(kept.size(), first.size() / 3);
  EXPECT_EQ(WithSameTorques(arm.robot, arm.robot, arm.scale, first).size(),
            first.size());
  const auto in_second = [&second](const GapCandidate& one) {
    const auto same = std::find_if(
        second.begin(), second.end(), [&one](const GapCandidate& other) {
          return SamePlace(one, other) && one.p == other.p &&
                 one.size == other.size;
        });
    CHECK(same != second.end());
    return *same;
  };
  for (const GapCandidate& one : kept) {  // what is integrated is right to 1e-9
    EXPECT_EQ(one.joint, 1);
    EXPECT_LT(Difference(one, in_second(one)), 1e-8) << one.place();
  }
  double own = 0, crosstalk = 0;
  for (const GapCandidate& one : first) {
    const double difference = Difference(one, in_second(one));
    if (one.joint == 0) own = std::max(own, difference);
    if (one.place() == "torque_crosstalk@2") crosstalk = difference;
  }
  EXPECT_GT(own, .01);
  EXPECT_GT(crosstalk, .01);
}

// A moment along the only axis that turns its link shows in no joint: what
// rounding makes of it is no torque, by which a fit would divide.
TEST(CandidateTorques, OfWhatNoJointShowsThereIsNone) {
  const EffectArm arm("3R elbow", 20, .01);
  Robot lift = arm.robot;  // with a joint that swivels, and one that tilts
  lift.links[0].joint.type = JointType::kPrismatic;
  for (Link& link : lift.links) {
    link.X_PF.setIdentity();
    link.X_PF.translation() << .3, 0, .1;
    link.X_ML.setIdentity();
  }
  lift.links[2].X_PF.rotate(
      Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
  lift.X_LT.setIdentity();
  const auto candidates = EvaluatedFor(lift, arm);
  const auto payload = std::find_if(
      candidates.begin(), candidates.end(),
      [](const auto& one) { return one.effect->name == "payload"; });
  ASSERT_NE(payload, candidates.end());
  const auto shows = [&](int parameter) {
    const JointRows& torque = payload->torque[parameter];
    return std::any_of(torque.begin(), torque.end(),
                       [](const VectorXd& own) { return own.size() > 0; });
  };
  EXPECT_TRUE(shows(0) && shows(1) && shows(2));
  EXPECT_FALSE(shows(3));  // hz
}

}  // namespace armcal::candidate_torques_test
