// growth_case samples|joints SAMPLES JOINTS: calibrates a log in memory and
// prints the CPU seconds that took and the log's size as JSON, for growth.py.

#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "model/inverse_dynamics.h"
#include "tests/in_memory_calibration.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {
namespace {

double CpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * now.tv_nsec;
}

// Sample by sample, so that there is never more than the log in memory.
Trajectory Record(const Robot& robot, int samples, std::mt19937_64* random) {
  const int n = robot.num_joints();
  const Multisine motion = RandomMultisine(random, n);
  Trajectory t;
  t.dt = 1e-3;
  for (Eigen::MatrixXd* x : {&t.q, &t.qd, &t.qdd, &t.tau})
    x->resize(samples, n);
  for (int k = 0; k < samples; ++k) {
    const Eigen::ArrayXXd angle =
        (motion.omega * t.time(k) + motion.phase).array();
    const Eigen::ArrayXXd A = motion.amplitude, w = motion.omega;
    const Eigen::VectorXd q =
        motion.offset + (A * angle.sin()).rowwise().sum().matrix();
    const Eigen::VectorXd qd = (A * w * angle.cos()).rowwise().sum();
    const Eigen::VectorXd qdd = -(A * w * w * angle.sin()).rowwise().sum();
    t.q.row(k) = q;
    t.qd.row(k) = qd;
    t.qdd.row(k) = qdd;
    t.tau.row(k) = InverseDynamics(robot, q, qd, qdd);
    for (int j = 0; j < n; ++j) t.tau(k, j) += .05 * Normal(random);
  }
  t.standstill.setConstant(samples, false);
  t.core_end = samples;
  return t;
}

int Main(char** arguments) {
  const int samples = std::atoi(arguments[2]), joints = std::atoi(arguments[3]);
  std::mt19937_64 random(1);
  Robot robot = RandomArm(joints, &random);
  SetRandomInertials(&random, &robot);
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
  options.transitions.assign(joints, {CoulombTransition()});
  const ModelParameters parameters(robot, options);
  const Trajectory log = Record(robot, samples, &random);
  RowOptions rows;
  rows.identification = Identification::kDifferential;
  const double begin = CpuSeconds();
  const InMemoryCalibration calibration(parameters, rows, log);
  const double seconds = CpuSeconds() - begin;
  const double bytes = samples * (4.0 * sizeof(double) * joints + sizeof(bool));
  std::printf("{\"seconds\": %.6g, \"log_mb\": %.6g}\n", seconds,
              bytes / (1 << 20));
  return calibration.covariance.allFinite() ? 0 : 1;
}

}  // namespace
}  // namespace armcal

int main(int count, char** arguments) {
  if (count != 4) {
    std::fprintf(stderr, "usage: growth_case samples|joints SAMPLES JOINTS\n");
    return 2;
  }
  return armcal::Main(arguments);
}
