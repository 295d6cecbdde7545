#include "calib/given_information.h"

#include <vector>

#include "problems/motion_information.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the weak form's test function (1 - s^2)^4: int phi^2 ds / (int phi ds)^2
// over [-1, 1], by Wallis' integrals 2 (2 4 .. 2 n) / (3 5 .. 2 n + 1).
double SquareOverMean() {
  const auto wallis = [](int n) {
    double value = 2;
    for (int k = 1; k <= n; ++k) value *= 2. * k / (2 * k + 1);
    return value;
  };
  return wallis(8) / (wallis(4) * wallis(4));
}

// Its samples that count, as a motion.
Motion CountedMotion(const Trajectory& trajectory) {
  std::vector<int> counted;
  for (int s = trajectory.core_begin; s < trajectory.core_end; ++s) {
    if (!trajectory.standstill[s]) counted.push_back(s);
  }
  Motion motion;
  motion.dt = trajectory.dt;
  motion.q = trajectory.q(counted, Eigen::all);
  motion.qd = trajectory.qd(counted, Eigen::all);
  motion.qdd = trajectory.qdd(counted, Eigen::all);
  return motion;
}

}  // namespace

// The variance of a mean weighted by phi over a window of length L is the
// density times (2 / L) int phi^2 ds / (int phi ds)^2.
VectorXd ErrorDensity(const LinearCalibration& linear) {
  return linear.noise.cwiseAbs2() *
         (linear.rows.window_s / (2 * SquareOverMean()));
}

MatrixXd GivenInformation(const Robot& robot, const ModelParameters& model,
                          const VectorXd& density, const Progress& progress,
                          LogSet* logs) {
  MotionInformation information(robot, model);
  MatrixXd A = MatrixXd::Zero(model.size(), model.size());
  logs->ForEach(
      "what is known", progress, [&](int, const Trajectory& trajectory) {
        const Motion motion = CountedMotion(trajectory);
        if (motion.size() == 0) return;
        information.Evaluate(motion, motion.dt * density.cwiseInverse());
        A += information.A();
      });
  return A;
}

}  // namespace armcal
