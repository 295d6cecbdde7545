#include "calib/excite/motion_advice.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "calib/excite/given_information.h"
#include "calib/excite/information_scale.h"
#include "model/text/format.h"
#include "model/text/uniform_draw.h"
#include "problems/motion_information.h"
#include "problems/motion_limits.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two slow tones of each of `joints` about `posture`, as large as half of what
// limits leave on the nearer side.
Motion MoveJoints(const MotionLimits& limits, const VectorXd& posture,
                  const std::vector<int>& joints) {
  constexpr double kDuration = 12, kStep = .05;  // s
  const int samples = static_cast<int>(kDuration / kStep);
  Motion motion;
  motion.dt = kStep;
  motion.q = posture.transpose().replicate(samples, 1);
  motion.qd = motion.qdd = MatrixXd::Zero(samples, posture.size());
  std::mt19937_64 random(1);
  const auto share = [&] { return UniformDraw(&random); };
  for (const int j : joints) {
    const double room = std::max(
        .1 * (limits.upper[j] - limits.lower[j]),
        std::min(limits.upper[j] - posture[j], posture[j] - limits.lower[j]));
    for (int tone = 0; tone < 2; ++tone) {
      const double w = 2 * M_PI * (.15 + .45 * share());
      const double size = std::min(room / 4, limits.velocity[j] / (2 * w));
      const double phase = 2 * M_PI * share();
      for (int s = 0; s < samples; ++s) {
        const double angle = w * s * kStep + phase;
        motion.q(s, j) += size * std::sin(angle);
        motion.qd(s, j) += size * w * std::cos(angle);
        motion.qdd(s, j) -= size * w * w * std::sin(angle);
      }
    }
  }
  return motion;
}

std::vector<std::vector<int>> Choices(int n) {
  std::vector<std::vector<int>> choices;
  for (int i = 0; i < n; ++i) choices.push_back({i});
  for (int i = 0; i < n; ++i) {
    for (int k = i + 1; k < n; ++k) choices.push_back({i, k});
  }
  choices.emplace_back(n);
  std::iota(choices.back().begin(), choices.back().end(), 0);
  return choices;
}

VectorXd MeanPosture(const PreparedLogs& logs) {
  VectorXd sum;
  double count = 0;
  logs.ForEach("postures", {}, [&](int, const Trajectory& trajectory) {
    if (sum.size() == 0) sum = VectorXd::Zero(trajectory.q.cols());
    sum += trajectory.q.colwise().sum().transpose();
    count += static_cast<double>(trajectory.q.rows());
  });
  return sum / count;
}

}  // namespace

std::vector<AdvisedMotion> AdviseMotions(
    const Robot& robot, const LinearCalibration& linear,
    const LinearCalibrationOptions& options, const LogSet& logs) {
  constexpr int kMostMotions = 8;
  std::vector<AdvisedMotion> advice;
  const Identifiability& id = linear.identifiability;
  if (!linear.solved || id.batch_rank >= id.total) return advice;
  const InformationScale scale(robot, linear, options);
  std::vector<std::string> assumed;
  const MotionLimits limits = LimitsOf(robot, &assumed);
  const PreparedLogs prepared = Prepare(logs, linear.preparation);
  MatrixXd A =
      GivenInformation(robot, scale.model, scale.density, {}, prepared);
  const VectorXd posture = MeanPosture(prepared);
  std::vector<MatrixXd> of_choice;
  const auto choices = Choices(robot.num_joints());
  MotionInformation information(robot, scale.model);
  for (const std::vector<int>& joints : choices) {
    const Motion motion = MoveJoints(limits, posture, joints);
    information.Evaluate(motion, motion.dt * scale.density.cwiseInverse());
    of_choice.push_back(information.A());
  }
  int rank = scale.Rank(A);
  while (rank < scale.model.size() && advice.size() < kMostMotions) {
    size_t best = 0;
    int most = rank;
    for (size_t k = 0; k < choices.size(); ++k) {
      const int with = scale.Rank(A + of_choice[k]);
      if (with <= most) continue;
      most = with;
      best = k;
    }
    if (most == rank) break;
    rank = most;
    A += of_choice[best];
    advice.push_back({choices[best], rank});
  }
  return advice;
}

}  // namespace armcal
