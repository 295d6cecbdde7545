#include "model/dynamics/geometry_jacobian.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/fixtures/random_motion.h"
#include "tests/model/dynamics/particle_arm.h"

namespace armcal::geometry_jacobian_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Room for some rows of every joint's columns, and a row that must stay as it
// is.
struct Room {
  Room(const Room&) = delete;
  Room(int n, int columns, int count) {
    for (int i = 0; i < n; ++i) {
      matrices.push_back(MatrixXd::Constant(count + 1, columns, 12345));
    }
    for (MatrixXd& m : matrices) rows.push_back(m.data());
  }
  // Of one sample, n x columns.
  MatrixXd At(int sample) const {
    MatrixXd at(matrices.size(), matrices[0].cols());
    for (size_t i = 0; i < matrices.size(); ++i) {
      at.row(static_cast<int>(i)) = matrices[i].row(sample);
    }
    return at;
  }
  std::vector<MatrixXd> matrices;
  std::vector<double*> rows;
};

// Of every convention, with joints that slide, axes that are parallel and one
// that are nearly so, and frames anywhere on the links.
std::vector<Robot> Files(std::mt19937_64* random) {
  std::vector<Robot> files;
  for (const char* name :
       {"3R elbow", "SCARA RRPR", "PUMA560 6R", "UR5 6R", "Panda 7R"}) {
    files.push_back(SampleRobot(name));
  }
  for (int trial = 0; trial < 6; ++trial) {
    files.push_back(ArmWithFrames(1 + trial, trial, random));
    files.back().dh_convention.reset();
  }
  Robot modified = SampleRobot("UR5 6R");
  modified.dh_convention = DhConvention::kModified;
  for (int i = 0; i < 6; ++i) {
    DhParameters row{Uniform(random, -1, 1), Uniform(random, -1, 1),
                     i % 3 * M_PI_2, Uniform(random, -3, 3)};
    if (i == 4) modified.links[i].joint.type = JointType::kPrismatic;
    SetDhPose(row, DhConvention::kModified, &modified.links[i]);
  }
  files.push_back(modified);
  return files;
}

struct Case {
  Case(const Robot& from, std::mt19937_64* random)
      : file(from), robot(from), geometry(file) {
    SetRandomInertials(random, &robot);
    const VectorXd values =
        geometry.Values() + UniformVector(random, geometry.size(), -.2, .2);
    geometry.SetValues(values);
    truth = std::make_unique<ParticleArm>(robot, file, values);
    all.resize(geometry.size());
    std::iota(all.begin(), all.end(), 0);
  }
  Robot file, robot;
  ArmGeometry geometry;
  std::unique_ptr<ParticleArm> truth;
  std::vector<int> all;
};

TEST(GeometryJacobian, IsThatOfThePosesWrittenOut) {
  std::mt19937_64 random(1);
  for (const Robot& file : Files(&random)) {
    Case c(file, &random);
    const int n = file.num_joints(), size = c.geometry.size(), count = 3;
    SCOPED_TRACE(file.name + " of " + std::to_string(n));
    const RandomMotion motion(&random, count, n, 0);
    for (int s = 0; s < count; ++s) {
      const VectorXd q = motion.q.row(s), qd = motion.qd.row(s),
                     qdd = motion.qdd.row(s);
      MatrixXd tau(n, size), P = tau, D = tau;
      for (int k = 0; k < size; ++k) {
        const auto columns = c.truth->By(k, q, qd, qdd);
        tau.col(k) = columns.tau;
        P.col(k) = columns.P;
        D.col(k) = columns.D;
      }
      for (const simd::Kernels* kernels : simd::AvailableKernels()) {
        SCOPED_TRACE(kernels->instruction_set);
        const GeometryJacobian jacobian(c.robot, c.geometry, c.all, *kernels);
        Room of_tau(n, size, count), of_P(n, size, count), of_D(n, size, count);
        jacobian.Torque(motion.columns(), count, of_tau.rows.data(), count + 1);
        jacobian.Momentum(motion.columns(), count, of_P.rows.data(),
                          of_D.rows.data(), count + 1);
        MatrixXd one_P, one_D;
        jacobian.Momentum(q, qd, &one_P, &one_D);
        for (const MatrixXd& found :
             {of_tau.At(s), jacobian.Torque(q, qd, qdd)}) {
          EXPECT_LT((found - tau).norm(), 1e-13 * (1 + tau.norm()));
        }
        for (const MatrixXd& found : {of_P.At(s), one_P}) {
          EXPECT_LT((found - P).norm(), 1e-13 * (1 + P.norm()));
        }
        for (const MatrixXd& found : {of_D.At(s), one_D}) {
          EXPECT_LT((found - D).norm(), 1e-13 * (1 + D.norm()));
        }
      }
    }
  }
}

// Whatever is asked for, in whatever batches: the same bits, in that order.
TEST(GeometryJacobian, ColumnsAndSamplesDoNotDependOnOthers) {
  std::mt19937_64 random(2);
  Case c(SampleRobot("PUMA560 6R"), &random);
  const int n = 6, size = c.geometry.size();
  std::vector<int> some = {size - 1, 9, 3, 20, 10};
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    const GeometryJacobian jacobian(c.robot, c.geometry, c.all, *kernels);
    const GeometryJacobian part(c.robot, c.geometry, some, *kernels);
    for (const int count : kCounts) {
      const RandomMotion motion(&random, count, n, 0);
      Room all(n, size, count), of_some(n, 5, count), D(n, 5, count);
      jacobian.Torque(motion.columns(), count, all.rows.data(), count + 1);
      part.Torque(motion.columns(), count, of_some.rows.data(), count + 1);
      for (int s = 0; s < count; ++s) {
        ASSERT_EQ(of_some.At(s), all.At(s)(Eigen::all, some));
      }
      EXPECT_TRUE((all.At(count).array() == 12345).all());
      Room one(n, size, 1);
      const int last = count - 1;
      const MotionColumns at(motion.q, motion.qd, motion.qdd, {}, last);
      jacobian.Torque(at, 1, one.rows.data(), 2);
      EXPECT_EQ(one.At(0), all.At(last));
      part.Momentum(motion.columns(), count, of_some.rows.data(), D.rows.data(),
                    count + 1);
      EXPECT_TRUE((of_some.At(count).array() == 12345).all());
      EXPECT_TRUE((D.At(count).array() == 12345).all());
    }
  }
}

}  // namespace armcal::geometry_jacobian_test
