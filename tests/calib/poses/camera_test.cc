// Arms calibrated from images of a board.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "tests/fixtures/board_camera.h"
#include "tests/fixtures/sample_poses.h"
#include "tests/fixtures/solved_posture.h"

namespace armcal::camera_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// An arm whose file is half a millimetre and three milliradians off; a camera
// on its flange and a board before it, or the other way round.
struct Campaign {
  Campaign(std::uint64_t seed, CameraPlace place)
      : random(seed), place(place), file(SampleRobot("UR5 6R")) {
    ArmGeometry geometry(file);
    truth = geometry.Values();
    for (int k = 6; k + 6 < geometry.size(); ++k) {
      const bool length = geometry.Units()[k] == "m";
      truth[k] += (length ? 5e-4 : 3e-3) * Normal(&random);
    }
    truth.tail<6>() << .03, -.05, .08, .4, -.05, .1;
    X_0B.linear() = RotationFromRpy({.05, .02, .3});
    X_0B.translation() << -.55, .1, .05;
  }
  Isometry3d Tool(const VectorXd& q) const {
    return ArmGeometry(file).ToolPose(q, truth.data(), nullptr);
  }
  // X_0T of a view X_CB: T is the camera, or the board before one at X_0B.
  Isometry3d ToolFor(const Isometry3d& X_CB) const {
    return place == CameraPlace::kOnTool ? X_0B * X_CB.inverse() : X_0B * X_CB;
  }
  VectorXd PostureOf(const Isometry3d& X_0T) {
    std::optional<VectorXd> q;
    for (int tries = 0; tries < 20 && !q; ++tries) {
      q = SolvedPosture(
          [&](const VectorXd& at) {
            const Isometry3d X = X_0T.inverse() * Tool(at);
            const Eigen::AngleAxisd turn(X.linear());
            VectorXd e(6);
            e << X.translation(), turn.angle() * turn.axis();
            return e;
          },
          UniformVector(&random, 6, -2, 2));
    }
    return q.value_or(VectorXd());
  }
  void Photograph(int count) {
    images = BoardImages();
    images.q.resize(count, 6);
    for (int k = 0; k < count; ++k) {
      VectorXd q;
      Isometry3d X_CB;
      while (q.size() == 0) {
        X_CB = RandomView(&random);
        q = PostureOf(ToolFor(X_CB));
      }
      images.q.row(k) = q.transpose();
      images.row.push_back(2 + 54 * k);
      images.number.push_back(k + 1);
      images.points.push_back(BoardPoints());
      views.push_back(X_CB);
    }
  }
  PoseCalibration Calibrate(double noise, RefineGeometry refine) {
    images.pixels.clear();
    for (const Isometry3d& X_CB : views) {
      images.pixels.push_back(Pixels(BoardPoints(), X_CB, noise, &random));
    }
    PoseCalibrationOptions options;
    options.refine = refine;
    options.folds = 0;
    return CalibratePoses(
        file, MeasurePoses("board.csv", images, HandCamera(), place), options);
  }
  // rms of the tool's position beside the true one, at postures near those
  // that were photographed, m.
  double ToolError(const PoseCalibration& c) {
    ArmGeometry geometry(file);
    VectorXd values = geometry.Values();
    const auto names = geometry.Names();
    for (const GeometryEstimate& p : c.parameters) {
      for (int k = 0; k < geometry.size(); ++k) {
        if (names[k] == p.name) values[k] = p.value;
      }
    }
    double squares = 0;
    for (Eigen::Index k = 0; k < images.q.rows(); ++k) {
      const VectorXd q =
          images.q.row(k).transpose() + UniformVector(&random, 6, -.3, .3);
      const Isometry3d found = geometry.ToolPose(q, values.data(), nullptr);
      squares +=
          (found.translation() - (X_0B.inverse() * Tool(q)).translation())
              .squaredNorm();
    }
    return std::sqrt(squares / images.q.rows());
  }

  std::mt19937_64 random;
  CameraPlace place;
  Robot file;
  VectorXd truth;
  Isometry3d X_0B = Isometry3d::Identity();
  BoardImages images;
  std::vector<Isometry3d> views;
};

class EachCamera : public testing::TestWithParam<CameraPlace> {};
INSTANTIATE_TEST_SUITE_P(Cameras, EachCamera,
                         testing::Values(CameraPlace::kOnTool,
                                         CameraPlace::kStanding));

// The bar is half of what zeros alone leave.
TEST_P(EachCamera, TheWholeGeometryHalvesWhatZerosLeave) {
  for (int seed = 1; seed <= 3; ++seed) {
    Campaign campaign(seed, GetParam());
    campaign.Photograph(60);
    const auto zeros = campaign.Calibrate(kPixel, RefineGeometry::kOffsets);
    const auto all = campaign.Calibrate(kPixel, RefineGeometry::kAll);
    ASSERT_TRUE(zeros.solved && all.solved) << all.reason;
    const double before = campaign.ToolError(zeros);
    const double after = campaign.ToolError(all);
    std::printf("tool error, mm: zeros %.3f, all %.3f\n", 1e3 * before,
                1e3 * after);
    EXPECT_LT(after, before / 2);
  }
}

// Against what exact pixels give with the same parameters held, which is the
// truth but for what nobody can tell.
TEST_P(EachCamera, IntervalsHoldTheTruth) {
  int inside = 0, all = 0;
  for (int seed = 21; seed <= 30; ++seed) {
    Campaign campaign(seed, GetParam());
    campaign.Photograph(60);
    const auto exact = campaign.Calibrate(0, RefineGeometry::kAll);
    const auto noisy = campaign.Calibrate(kPixel, RefineGeometry::kAll);
    ASSERT_TRUE(exact.solved && noisy.solved);
    EXPECT_LT(exact.rms, 1e-6);
    ASSERT_EQ(exact.parameters.size(), noisy.parameters.size());
    for (size_t k = 0; k < exact.parameters.size(); ++k) {
      const GeometryEstimate& p = noisy.parameters[k];
      ++all;
      inside += std::abs(p.value - exact.parameters[k].value) < 1.96 * p.stddev;
    }
  }
  std::printf("%d of %d 95 %% intervals hold the truth\n", inside, all);
  // 95 % within three standard deviations of a count whose members are
  // correlated by about a half within a campaign.
  EXPECT_GT(inside, .90 * all);
  EXPECT_LT(inside, .99 * all);
}

TEST(Cameras, TwoHundredImagesTakeNotLong) {
  Campaign campaign(5, CameraPlace::kOnTool);
  campaign.Photograph(200);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(campaign.Calibrate(kPixel, RefineGeometry::kAll).solved);
  const std::chrono::duration<double> taken =
      std::chrono::steady_clock::now() - begin;
  std::printf("%.2f s\n", taken.count());
  EXPECT_LT(taken.count(), 5);
}

}  // namespace armcal::camera_test
