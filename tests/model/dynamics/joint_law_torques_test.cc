#include "model/dynamics/joint_law_torques.h"

#include <gtest/gtest.h>

namespace armcal::joint_law_torques_test {

using Eigen::VectorXd;

constexpr int kSamples = 50;
constexpr double kStep = .02;  // s

// q = t^2, qd = 2 t: interpolation and steps of order 2 make no error.
MotionTrack Accelerating() {
  MotionTrack track;
  track.t = VectorXd::LinSpaced(kSamples, 0, (kSamples - 1) * kStep);
  track.position = track.t.cwiseAbs2().transpose();
  track.velocity = 2 * track.t.transpose();
  track.load = track.warmth = Eigen::MatrixXd::Zero(1, kSamples);
  return track;
}

// As many states as asked for; the k-th is k + 1 times the way since the start.
JointLaw Odometer(int states) {
  JointLaw law;
  law.initial_state = VectorXd::Zero(states);
  law.torque = [states](const ArmInstant& at, const double* x, double* rate) {
    double sum = at.t;
    for (int k = 0; k < states; ++k) {
      sum += x[k];
      rate[k] = (k + 1) * at.velocity[0];
    }
    return sum;
  };
  return law;
}

TEST(JointLawTorques, StatesFollowTheMotionTogetherAsAlone) {
  const MotionTrack track = Accelerating();
  std::vector<JointLaw> laws;
  for (const int states : {1, 0, 2, 1, 3}) laws.push_back(Odometer(states));
  std::vector<const JointLaw*> all;
  for (const JointLaw& law : laws) all.push_back(&law);
  const std::vector<VectorXd> together = JointLawTorques(all, track);
  ASSERT_EQ(together.size(), laws.size());
  for (size_t i = 0; i < laws.size(); ++i) {
    const auto n = static_cast<double>(laws[i].initial_state.size());
    const VectorXd expected =
        track.t + n * (n + 1) / 2 * track.position.transpose();
    EXPECT_LT((together[i] - expected).cwiseAbs().maxCoeff(), 1e-9) << i;
    EXPECT_EQ(JointLawTorques({all[i]}, track)[0], together[i]) << i;
  }
}

// Laws of one number are asked for their torque as often as one of them alone,
// and those without a number are each a law of its own.
TEST(JointLawTorques, CopiesAreFollowedOnce) {
  const MotionTrack track = Accelerating();
  int calls = 0;
  JointLaw law = Odometer(1);
  law.torque = [&calls, torque = law.torque](const ArmInstant& at,
                                             const double* x, double* rate) {
    ++calls;
    return torque(at, x, rate);
  };
  const VectorXd alone = JointLawTorques({&law}, track)[0];
  const int once = calls;
  JointLaw copy = law, other = law;
  law.copy_of = copy.copy_of = 7;
  calls = 0;
  for (const VectorXd& torque : JointLawTorques({&law, &copy, &law}, track)) {
    EXPECT_EQ(torque, alone);
  }
  EXPECT_EQ(calls, once);
  calls = 0;
  EXPECT_EQ(JointLawTorques({&other, &law, &other}, track).size(), 3u);
  EXPECT_EQ(calls, 3 * once);
}

}  // namespace armcal::joint_law_torques_test
