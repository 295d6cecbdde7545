#include "calib/poses/cameras/camera_rig.h"

#include <gtest/gtest.h>

#include "model/robot/rotations.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::camera_rig_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

Isometry3d RandomFrame(std::mt19937_64* random) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = RotationFromRpy(UniformVector(random, 3, -1, 1));
  X.translation() = UniformVector(random, 3, -1, 1);
  return X;
}

// Of two poses in W: the displacement and the rotation from A to B.
Vector6d Difference(const Isometry3d& A, const Isometry3d& B) {
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(B.linear() * A.linear().transpose()));
  Vector6d difference;
  difference << B.translation() - A.translation(), turn.angle() * turn.axis();
  return difference;
}

struct Sample {
  explicit Sample(CameraPlace place) : place(place) {}
  CameraRig Rig(const HandEye& with) const {
    return CameraRig(place, with, further, seen);
  }
  std::mt19937_64 random{3};
  CameraPlace place;
  HandEye first{RandomFrame(&random), RandomFrame(&random)};
  HandEye further{RandomFrame(&random), RandomFrame(&random)};
  std::vector<Isometry3d> seen{RandomFrame(&random), RandomFrame(&random),
                               RandomFrame(&random)};
};

class EachRig : public testing::TestWithParam<CameraPlace> {};
INSTANTIATE_TEST_SUITE_P(Cameras, EachRig,
                         testing::Values(CameraPlace::kOnTool,
                                         CameraPlace::kStanding));

constexpr double kStep = 1e-6;

// Of an error in what the further camera saw.
TEST_P(EachRig, CarryIsTheDerivativeByWhatWasSeen) {
  const Sample s(GetParam());
  const CameraRig rig = s.Rig(s.first);
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    const Vector6d slope = Difference(rig.InFirst(Displaced(s.seen[0], -step)),
                                      rig.InFirst(Displaced(s.seen[0], step))) /
                           (2 * kStep);
    EXPECT_LT((slope - rig.Carry(s.seen[0]).col(k)).norm(), 1e-8) << k;
  }
}

// Of where the further camera is: by the first one's frame on the tool, in its
// own axes; by the standing one's, in W's axes about the middle of what it saw.
TEST_P(EachRig, MovesAreDerivativesByWhereItIs) {
  const Sample s(GetParam());
  const CameraRig rig = s.Rig(s.first);
  Vector3d middle = Vector3d::Zero();
  for (const Isometry3d& X : s.seen) middle += rig.InFirst(X).translation() / 3;
  const auto moved = [&](const Vector6d& by) {
    HandEye first = s.first;
    const Isometry3d D = Displaced(Isometry3d::Identity(), by);
    if (s.place == CameraPlace::kOnTool) {
      first.X_ET = first.X_ET * D;
    } else {
      const Eigen::Translation3d there(middle), back(-middle);
      const Isometry3d turn(D.linear());
      first.X_WB =
          Eigen::Translation3d(by.head<3>()) * there * turn * back * first.X_WB;
    }
    return s.Rig(first);
  };
  for (int k = 0; k < 6; ++k) {
    const Vector6d step = kStep * Vector6d::Unit(k);
    const CameraRig plus = moved(step), minus = moved(-step);
    const Vector6d slope =
        Difference(minus.InFirst(s.seen[0]), plus.InFirst(s.seen[0])) /
        (2 * kStep);
    EXPECT_LT((slope - rig.Moves(s.seen[0]).col(k)).norm(), 1e-8) << k;
    const Vector6d values = (plus.Values() - minus.Values()) / (2 * kStep);
    EXPECT_LT((values - rig.ValuesByMoves().col(k)).norm(), 1e-7) << k;
  }
}

}  // namespace armcal::camera_rig_test
