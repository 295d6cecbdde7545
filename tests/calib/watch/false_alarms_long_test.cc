#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "calib/watch/watcher.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::false_alarms_long_test {

using Eigen::VectorXd;

constexpr double kStep = .001;
constexpr double kPiece = 300;  // s of one motion
constexpr double kHours = 5;    // of each arm

// An arm whose sensors and friction are not what the watcher takes them for:
// friction turns along v / sqrt(v^2 + w^2), encoders round, torques have white
// and correlated noise of 1 % and .5 % of their usual size, and the parameters
// are those of the model plus a draw of its covariance.
class RealArm {
 public:
  RealArm(const Robot& robot, int seed) : robot_(robot), random_(seed) {
    for (Link& link : robot_.links) {
      for (double* value :
           {&link.joint.viscous, &link.joint.coulomb, &link.joint.armature}) {
        *value *= 1 + .01 * Normal(&random_);
      }
      Vector10d V = link.inertial.ToVector();
      V *= 1 + .01 * Normal(&random_);
      link.inertial = InertialParameters::FromVector(V);
    }
    coloured_ = VectorXd::Zero(robot.num_joints());
  }

  std::mt19937_64* random() { return &random_; }

  VectorXd Torque(const VectorXd& q, const VectorXd& qd, const VectorXd& qdd,
                  const VectorXd& usual) {
    constexpr double kWidth = .005, kCorrelation = .05;
    VectorXd tau = InverseDynamics(robot_, q, qd, qdd);
    const double keep = std::exp(-kStep / kCorrelation);
    for (int j = 0; j < tau.size(); ++j) {
      const Joint& joint = robot_.links[j].joint;
      coloured_[j] =
          keep * coloured_[j] + std::sqrt(1 - keep * keep) * Normal(&random_);
      tau[j] += joint.viscous * qd[j] + joint.armature * qdd[j] +
                joint.coulomb * qd[j] / std::hypot(qd[j], kWidth) +
                usual[j] * (.01 * Normal(&random_) + .005 * coloured_[j]);
    }
    return tau;
  }

  static VectorXd Encoders(const VectorXd& q) {
    constexpr double kResolution = 5e-6;
    return (q / kResolution).array().round() * kResolution;
  }

 private:
  Robot robot_;
  std::mt19937_64 random_;
  VectorXd coloured_;
};

// Motions of one piece: a multisine at a random speed, or moves by quintic
// polynomials between random points, with rests.
class Motion {
 public:
  Motion(std::mt19937_64* random, int n, bool points)
      : random_(random),
        points_(points),
        speed_(Uniform(random, .5, 1.2)),
        sines_(RandomMultisine(random, n)),
        from_(UniformVector(random, n, -1, 1)),
        to_(from_) {}

  void At(double t, VectorXd* q, VectorXd* qd, VectorXd* qdd) {
    if (points_) return MoveAt(t, q, qd, qdd);
    *q = sines_.offset;
    qd->setZero(q->size());
    qdd->setZero(q->size());
    for (Eigen::Index k = 0; k < sines_.omega.cols(); ++k) {
      const Eigen::ArrayXd w = speed_ * sines_.omega.col(k).array();
      const Eigen::ArrayXd a = sines_.amplitude.col(k).array();
      const Eigen::ArrayXd phase = w * t + sines_.phase.col(k).array();
      q->array() += a * phase.sin();
      qd->array() += a * w * phase.cos();
      qdd->array() -= a * w * w * phase.sin();
    }
  }

 private:
  void MoveAt(double t, VectorXd* q, VectorXd* qd, VectorXd* qdd) {
    if (t >= end_ + rest_) {
      begin_ = t;
      from_ = to_;
      to_ = UniformVector(random_, static_cast<int>(from_.size()), -1, 1);
      end_ = t + (to_ - from_).cwiseAbs().maxCoeff() * 1.875 / speed_;
      rest_ = Uniform(random_, .2, 1.5);
    }
    const double T = end_ - begin_;
    const double s = std::min((t - begin_) / T, 1.);
    const VectorXd way = to_ - from_;
    *q = from_ + way * (s * s * s * (10 - 15 * s + 6 * s * s));
    *qd = way * (30 * s * s * (1 - s) * (1 - s) / T);
    *qdd = way * (60 * s * (1 - s) * (1 - 2 * s) / (T * T));
  }

  std::mt19937_64* random_;
  bool points_;
  double speed_;
  Multisine sines_;
  VectorXd from_, to_;
  double begin_ = 0, end_ = 0, rest_ = 0;
};

WatchModel ModelOf(const Robot& robot) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  const CoulombTransition law{CoulombTransition::Law::kVelocity, .006};
  options.transitions.assign(robot.num_joints(), {law});
  WatchModel model{robot, ModelParameters(robot, options), {}, {}, {}, {}};
  model.x = model.parameters.Values(robot);
  const VectorXd stddev = (.02 * model.x.cwiseAbs()).cwiseMax(2e-3).matrix();
  model.covariance = stddev.cwiseAbs2().asDiagonal();
  model.residual_rms = VectorXd::Constant(robot.num_joints(), .1);
  model.torque_rms = VectorXd::Constant(robot.num_joints(), 15);
  return model;
}

double ResidentMegabytes() {
  std::ifstream file("/proc/self/statm");
  long all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096. / (1 << 20);
}

struct Watching {
  int told = 0;
  double memory_after_an_hour = 0, memory = 0;  // MB
};

Watching WatchHours(const std::string& name, int seed) {
  std::mt19937_64 random(seed);
  Robot robot = SampleRobot(name);
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) {
    link.has_inertial = true;
    link.joint.viscous = Uniform(&random, .5, 2);
    link.joint.coulomb = Uniform(&random, .5, 3);
    link.joint.armature = Uniform(&random, .1, .6);
  }
  RealArm arm(robot, seed + 1);
  Watching watching;
  Watcher watcher(ModelOf(robot), {}, [&](const WatchEvent& event) {
    if (!IsChange(event.kind) && event.kind != WatchEvent::Kind::kLearned)
      return;
    watching.told += IsChange(event.kind);
    std::printf("%s\n", ToText(event).c_str());
    std::fflush(stdout);
  });
  const VectorXd usual = VectorXd::Constant(robot.num_joints(), 15);
  const long pieces = std::lround(kHours * 3600 / kPiece);
  VectorXd q, qd, qdd;
  for (long piece = 0; piece < pieces; ++piece) {
    Motion motion(arm.random(), robot.num_joints(), piece % 2 == 1);
    for (double t = 0; t < kPiece; t += kStep) {
      motion.At(t, &q, &qd, &qdd);
      watcher.Add(piece * (kPiece + 1) + t, RealArm::Encoders(q),
                  arm.Torque(q, qd, qdd, usual));
    }
    if (piece == 11) watching.memory_after_an_hour = ResidentMegabytes();
  }
  watching.memory = ResidentMegabytes();
  return watching;
}

// Ten hours at 1 kHz, half of them of a seven-joint arm, made in memory.
TEST(WatchFalseAlarms, AreFewerThanOneInTenHours) {
  const Watching six = WatchHours("PUMA560 6R", 301);
  const Watching seven = WatchHours("Panda 7R", 302);
  std::printf(
      "six joints: %d told, %.1f MB after an hour, %.1f at the end\n"
      "seven: %d told, %.1f MB, %.1f MB\n",
      six.told, six.memory_after_an_hour, six.memory, seven.told,
      seven.memory_after_an_hour, seven.memory);
  EXPECT_LT(six.told + seven.told, 10);  // less than one an hour
  EXPECT_LT(six.memory, six.memory_after_an_hour + 2);
  EXPECT_LT(seven.memory, seven.memory_after_an_hour + 2);
}

}  // namespace armcal::false_alarms_long_test
