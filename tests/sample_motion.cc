#include "tests/sample_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/inverse_dynamics.h"
#include "tests/sample_robots.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Multisine RandomMultisine(std::mt19937_64* random, int n, double size) {
  constexpr int kTones = 3;
  Multisine motion;
  motion.offset = UniformVector(random, n, -1, 1);
  motion.amplitude.resize(n, kTones);
  motion.omega.resize(n, kTones);
  motion.phase.resize(n, kTones);
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < kTones; ++k) {
      motion.amplitude(j, k) = size * Uniform(random, .2, .5);
      motion.omega(j, k) = 2 * M_PI * Uniform(random, .1, .6);
      motion.phase(j, k) = Uniform(random, 0, 2 * M_PI);
    }
  }
  return motion;
}

Multisine ScaraMultisine() {
  Multisine motion;
  motion.offset = Eigen::Vector4d(0, .4, 0, 0);
  motion.amplitude.resize(4, 3);
  motion.omega.resize(4, 3);
  motion.phase.resize(4, 3);
  motion.amplitude << .5, .15, .08, .6, -.2, .07, .06, .02, .008, .7, .3, .1;
  motion.omega << .25, .6, 1.1, .4, .75, 1.3, .5, .8, 1.6, .3, .7, 1.2;
  motion.omega *= 2 * M_PI;
  motion.phase << 4.000119, 1.694261, .257314, .103794, 5.107337, 5.732105,
      3.809673, 4.581238, 3.413965, 5.872255, 5.12356, .017198;
  return motion;
}

Log RecordMotion(const Multisine& motion, double duration, double dt) {
  const long samples = std::lround(duration / dt) + 1;
  const Eigen::Index n = motion.offset.size();
  Log log;
  log.t =
      VectorXd::LinSpaced(samples, 0, static_cast<double>(samples - 1) * dt);
  log.q.resize(samples, n);
  log.qd.resize(samples, n);
  log.qdd.resize(samples, n);
  for (long k = 0; k < samples; ++k) {
    const auto w = motion.omega.array();
    const auto a = motion.amplitude.array();
    const Eigen::ArrayXXd angle = w * log.t[k] + motion.phase.array();
    log.q.row(k) = motion.offset.array() + (a * angle.sin()).rowwise().sum();
    log.qd.row(k) = (a * w * angle.cos()).rowwise().sum();
    log.qdd.row(k) = -(a * w * w * angle.sin()).rowwise().sum();
  }
  return log;
}

void AddTorque(const Robot& robot, Log* log) {
  if (log->tau.size() == 0) log->tau.setZero(log->size(), robot.num_joints());
  for (int k = 0; k < log->size(); ++k) {
    log->tau.row(k) +=
        InverseDynamics(robot, log->q.row(k), log->qd.row(k), log->qdd.row(k));
  }
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    log->tau.col(j) +=
        joint.viscous * log->qd.col(j) + joint.armature * log->qdd.col(j);
  }
}

void AddCoulomb(int j, double size, const CoulombTransition& transition,
                Log* log) {
  double state = 0;
  for (int k = 0; k < log->size(); ++k) {
    if (transition.law == CoulombTransition::Law::kVelocity) {
      state = std::tanh(log->qd(k, j) / transition.width);
    } else if (k > 0) {
      state += (log->q(k, j) - log->q(k - 1, j)) / transition.width;
      state = std::min(1.0, std::max(-1.0, state));
    }
    log->tau(k, j) += size * state;
  }
}

VectorXd PaperScaraTruth() {
  VectorXd X(6);
  X << 17.55, 7.55, 2.343, .176, 3.11, .35;
  return X;
}

void SetPaperScaraTorque(Log* log) {
  const VectorXd X = PaperScaraTruth();
  log->tau.resize(log->size(), 4);
  for (int k = 0; k < log->size(); ++k) {
    const double s = std::sin(log->q(k, 1)), c = std::cos(log->q(k, 1));
    const double v1 = log->qd(k, 0), v2 = log->qd(k, 1);
    const auto a = log->qdd.row(k);
    log->tau(k, 0) =
        a[0] * X[0] + a[1] * X[1] + a[3] * X[5] +
        ((2 * a[0] + a[1]) * c - (2 * v1 * v2 + v2 * v2) * s) * X[2] -
        ((2 * a[0] + a[1]) * s + (2 * v1 * v2 + v2 * v2) * c) * X[3];
    log->tau(k, 1) = (a[0] + a[1]) * X[1] + (a[0] * c + v1 * v1 * s) * X[2] +
                     (v1 * v1 * c - a[0] * s) * X[3] + a[3] * X[5];
    log->tau(k, 2) = (a[2] - 9.8) * X[4];
    log->tau(k, 3) = (a[0] + a[1] + a[3]) * X[5];
  }
}

double Normal(std::mt19937_64* random) {  // Box and Muller
  const double radius = std::sqrt(-2 * std::log(1 - Uniform(random, 0, 1)));
  return radius * std::cos(2 * M_PI * Uniform(random, 0, 1));
}

void AddNoise(std::mt19937_64* random, const VectorXd& sigma, MatrixXd* x) {
  for (Eigen::Index k = 0; k < x->rows(); ++k) {
    for (Eigen::Index j = 0; j < x->cols(); ++j) {
      (*x)(k, j) += sigma[j] * Normal(random);
    }
  }
}

VectorXd ColumnRms(const MatrixXd& x) {
  return (x.colwise().squaredNorm() / static_cast<double>(x.rows()))
      .cwiseSqrt()
      .transpose();
}

Trajectory MakeTrajectory(const Log& log) {
  Trajectory t;
  t.t0 = log.t[0];
  t.dt = (log.t[log.size() - 1] - log.t[0]) / (log.size() - 1);
  t.q = log.q;
  t.qd = log.qd;
  t.qdd = log.qdd;
  t.tau = t.tau_recorded = log.tau;
  t.standstill.setConstant(log.size(), false);
  t.core_end = log.size();
  return t;
}

std::string LogCsv(const Log& log, bool with_rates) {
  std::vector<std::pair<std::string, const MatrixXd*>> signals = {
      {"q", &log.q}, {"tau", &log.tau}, {"temp", &log.temperature}};
  if (with_rates) {
    signals.insert(signals.end(), {{"qd", &log.qd}, {"qdd", &log.qdd}});
  }
  std::string text = "t";
  for (const auto& [name, x] : signals) {
    for (Eigen::Index j = 1; j <= x->cols(); ++j) {
      text += "," + name + std::to_string(j);
    }
  }
  char number[32];
  for (int k = 0; k < log.size(); ++k) {
    std::snprintf(number, sizeof(number), "\n%.9f", log.t[k]);
    text += number;
    for (const auto& signal : signals) {
      for (Eigen::Index j = 0; j < signal.second->cols(); ++j) {
        std::snprintf(number, sizeof(number), ",%.17g", (*signal.second)(k, j));
        text += number;
      }
    }
  }
  return text + "\n";
}

}  // namespace armcal
