#include "calib/diagnose/contacts/contacts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/robot/kinematics.h"
#include "model/signals/dense_solvers.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::contacts_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kStep = .004, kBandwidth = 10, kThreshold = 6;
constexpr double kNoise = .5;  // N m
constexpr int kSize = 5000;    // samples: 20 s

// An arm that rests, moves from 8 to 12 s, and rests. What its torque is beyond
// the model's is given sample by sample.
class GapContacts : public testing::Test {
 protected:
  GapContacts() : robot_(SampleRobot("UR5 6R")) {
    for (int j = 0; j < 6; ++j) robot_.links[j].joint.coulomb = Coulomb(j);
    GapSegment segment;
    Motion& motion = segment.motion;
    motion.dt = kStep;
    motion.q.resize(kSize, 6);
    motion.qd.setZero(kSize, 6);
    segment.tau.setZero(kSize, 6);
    const VectorXd start = (VectorXd(6) << .3, -1, 1.2, -.4, .8, .2).finished();
    for (int k = 0; k < kSize; ++k) {
      const double s = std::clamp((k * kStep - 8) / 4, 0., 1.);
      motion.q.row(k).setConstant(.4 * (1 - std::cos(M_PI * s)));
      motion.q.row(k) += start;
      motion.qd.row(k).setConstant(.1 * M_PI * std::sin(M_PI * s));
    }
    segment.still = motion.qd.array() == 0;
    segments_ = {segment};
    rows_.emplace(segments_, kBandwidth);
    std::vector<Autoregression> noise(6);
    for (Autoregression& joint : noise) joint.sigma = kNoise;
    rows_->SetNoise(noise, MatrixXd::Zero(rows_->num_thin(), 6));
    residual_ = MatrixXd::Zero(rows_->num_thin(), 6);
    AddNoise(&random_, VectorXd::Constant(6, kNoise), &residual_);
  }
  static double Coulomb(int j) { return j < 2 ? 20 : j < 3 ? 8 : 3; }
  double time(int k) const { return rows_->thin_time(0, k); }

  // At rest, friction holds this share of what it can.
  void AddFriction(double share, double begin, double end) {
    for (int k = 0; k < rows_->num_thin(); ++k) {
      if (time(k) < begin || time(k) > end) continue;
      for (int j = 0; j < 6; ++j) residual_(k, j) += share * Coulomb(j);
    }
  }
  // By differences of the tool's place.
  VectorXd TorqueOf(const Vector3d& force, double t) const {
    const VectorXd q = segments_[0].motion.q.row(std::lround(t / kStep));
    VectorXd tau(6);
    for (int j = 0; j < 6; ++j) {
      const VectorXd step = 1e-6 * VectorXd::Unit(6, j);
      tau[j] = force.dot(ToolPose(robot_, q + step).translation() -
                         ToolPose(robot_, q - step).translation()) /
               2e-6;
    }
    return tau;
  }
  // The motors hold against it.
  void AddPush(const std::function<VectorXd(double)>& torque, double begin,
               double end) {
    for (int k = 0; k < rows_->num_thin(); ++k) {
      if (time(k) < begin || time(k) > end) continue;
      residual_.row(k) -= torque(time(k));
    }
  }
  void AddForce(const Vector3d& force, double begin, double end) {
    AddPush([&](double t) { return TorqueOf(force, t); }, begin, end);
  }
  std::vector<Contact> Find(ContactSearch search) const {
    const GapBaseline baseline(robot_, BaselineOptions(),
                               VectorXd::Constant(6, 10));
    return FindContacts(
        robot_, *rows_,
        ExcessOverFriction(baseline, VectorXd::Zero(baseline.size()), *rows_,
                           residual_),
        kThreshold, search);
  }

  Robot robot_;
  std::vector<GapSegment> segments_;
  std::optional<GapRows> rows_;
  MatrixXd residual_;
  std::mt19937_64 random_{1};
};

const Vector3d kPush(60, -70, 50);  // N

void ExpectForce(const Contact& contact, const Vector3d& truth) {
  ASSERT_TRUE(contact.force.has_value());
  const Vector3d error = contact.force->value - truth;
  // chi^2 of 3 degrees passes 21 once in 10000.
  EXPECT_LT(error.dot(contact.force->covariance.inverse() * error), 21)
      << contact.force->value.transpose();
  EXPECT_LT(error.norm(), .5 * truth.norm());
}

// Friction gives way from one side to the other meanwhile.
TEST_F(GapContacts, FindsAPushAtRest) {
  AddFriction(.5, 0, 3);
  AddFriction(-.5, 3, 3.6);
  AddFriction(.3, 3.6, 8);
  AddForce(kPush, 3, 3.6);
  const std::vector<Contact> found = Find(ContactSearch::kAtRest);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].window.begin, 3, .25);
  EXPECT_NEAR(found[0].window.end, 3.6, .25);
  const VectorXd truth = TorqueOf(kPush, 3);
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(found[0].torque[j], truth[j], 4 * found[0].stddev[j]) << j;
    EXPECT_LT(found[0].stddev[j], Coulomb(j)) << j;
  }
  ExpectForce(found[0], kPush);
}

TEST_F(GapContacts, APushAtRestEndsWhereTheArmSetsOff) {
  AddForce(kPush, 7.3, 8.1);
  const std::vector<Contact> found = Find(ContactSearch::kAtRest);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].window.begin, 7.3, .25);
  EXPECT_LT(found[0].window.end, 8.6);
}

TEST_F(GapContacts, FindsAPushInMotion) {
  AddForce(kPush, 9.5, 10.1);
  const std::vector<Contact> found = Find(ContactSearch::kOfTwoJoints);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_NEAR(found[0].window.begin, 9.5, .25);
  EXPECT_NEAR(found[0].window.end, 10.1, .25);
  const VectorXd truth = TorqueOf(kPush, found[0].time);
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(found[0].torque[j], truth[j], 5 * kNoise) << j;
  }
  ExpectForce(found[0], kPush);
}

TEST_F(GapContacts, OneJointThatMovesIsNotEnough) {
  const VectorXd torque = 60 * VectorXd::Unit(6, 1);
  AddPush([&](double) { return torque; }, 9.5, 10.1);
  EXPECT_THAT(Find(ContactSearch::kOfTwoJoints), IsEmpty());
  EXPECT_THAT(Find(ContactSearch::kInMotion), SizeIs(1));
  AddPush([&](double) { return torque; }, 3, 3.6);
  EXPECT_THAT(Find(ContactSearch::kAtRest), SizeIs(1));
  EXPECT_THAT(Find(ContactSearch::kInMotion), SizeIs(1));
}

TEST_F(GapContacts, WithinItsFrictionAnArmTellsNothing) {
  AddFriction(1, 0, 3);
  AddFriction(-1, 3, 8);
  AddFriction(.9, 12, 16);
  AddFriction(-.2, 16, 20);
  EXPECT_THAT(Find(ContactSearch::kAtRest), IsEmpty());
  EXPECT_THAT(Find(ContactSearch::kOfTwoJoints), IsEmpty());
}

// It neither comes nor goes while the arm rests.
TEST_F(GapContacts, AWeightIsNone) {
  AddForce({0, 0, -80}, 0, 20);
  EXPECT_THAT(Find(ContactSearch::kAtRest), IsEmpty());
}

// Somebody leans on the upper arm: the wrist feels nothing.
TEST_F(GapContacts, NoForceAtTheToolWhereTheWristFeelsNothing) {
  const VectorXd torque = (VectorXd(6) << 50, -70, 0, 0, 0, 0).finished();
  AddPush([&](double) { return torque; }, 3, 3.6);
  const std::vector<Contact> found = Find(ContactSearch::kAtRest);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].force.has_value());
  EXPECT_EQ(found[0].joint, 1);
  std::vector<double> stddev;
  const auto estimates = ContactEstimates(robot_, found[0], &stddev);
  EXPECT_EQ(estimates[0].name, "torque");
  EXPECT_NEAR(estimates[0].value, -70, 2 * stddev[0]);
}

// Along the line about which the joints have least lever, which the torques do
// not tell from a weaker one on another link.
TEST_F(GapContacts, NoForceWhereJointsHaveNoLever) {
  MatrixXd lever(6, 3);
  for (int k = 0; k < 3; ++k) lever.col(k) = TorqueOf(Vector3d::Unit(k), 3);
  const Eigen::JacobiSVD<MatrixXd> svd(lever, Eigen::ComputeFullV);
  const Vector3d force = 60 / svd.singularValues()[2] * svd.matrixV().col(2);
  ASSERT_GT(force.norm(), 200);
  AddForce(force, 3, 3.6);
  const std::vector<Contact> found = Find(ContactSearch::kAtRest);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_FALSE(found[0].force.has_value());
}

// A log in which friction is stronger than the model has it.
TEST_F(GapContacts, MoreFrictionIsNoContact) {
  for (int k = 0; k < rows_->num_thin(); ++k) {
    if (time(k) > 8.05 && time(k) < 11.95) residual_.row(k).array() += 4;
  }
  EXPECT_THAT(Find(ContactSearch::kOfTwoJoints), IsEmpty());
}

}  // namespace armcal::contacts_test
