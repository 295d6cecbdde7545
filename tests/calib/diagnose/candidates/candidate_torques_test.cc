#include "calib/diagnose/candidates/candidate_torques.h"

#include <glog/logging.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::candidate_torques_test {

using Eigen::VectorXd;

// Every effect of the catalogue at every joint, evaluated for a robot.
std::vector<GapCandidate> EvaluatedFor(const Robot& robot,
                                       const EffectArm& arm) {
  const GapBaseline baseline(robot, {}, VectorXd::Constant(2, 10));
  const std::vector<GapSegment> segments = {
      MakeSegment(arm.motion, arm.Recorded().nominal())};
  GapRows rows(segments, 6);
  rows.SetNoise(std::vector<Autoregression>(2),
                Eigen::MatrixXd::Zero(rows.num_thin(), 2));
  std::vector<GapCandidate> candidates =
      ListCandidates(baseline, rows, arm.scale,
                     Eigen::MatrixXd::Zero(rows.num_thin(), 2), {}, false);
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

}  // namespace armcal::candidate_torques_test
