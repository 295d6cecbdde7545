// Arms calibrated from images of a board.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/hand_eye.h"
#include "tests/fixtures/board_camera.h"
#include "tests/fixtures/calibrated_geometry.h"
#include "tests/fixtures/sample_poses.h"
#include "tests/fixtures/solved_posture.h"

namespace armcal::camera_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// An arm whose file is half a millimetre and three milliradians off; one camera
// or two on its flange and a board before it, or the other way round.
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
  // X_0T of a view X_CB: T is the first camera, or the board before that at
  // X_0B.
  Isometry3d ToolFor(int camera, const Isometry3d& X_CB) const {
    const Isometry3d from_first = camera == 0 ? Isometry3d::Identity() : second;
    return place == CameraPlace::kOnTool
               ? X_0B * X_CB.inverse() * from_first.inverse()
               : X_0B * from_first * X_CB;
  }
  VectorXd PostureOf(const Isometry3d& X_0T) {
    std::optional<VectorXd> q;
    for (int tries = 0; tries < 20 && !q; ++tries) {
      q = SolvedPosture(
          [&](const VectorXd& at) {
            return FrameError(X_0T.inverse() * Tool(at));
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
        q = PostureOf(ToolFor(k % cameras, X_CB));
      }
      images.q.row(k) = q.transpose();
      images.row.push_back(2 + 54 * k);
      images.number.push_back(k + 1);
      images.camera.push_back(k % cameras);
      images.points.push_back(BoardPoints());
      views.push_back(X_CB);
    }
  }
  CameraOptions Cameras() const {
    CameraOptions options;
    options.place = place;
    options.estimate_lens = estimate_lens;
    if (!estimate_lens) options.cameras.assign(cameras, HandCamera());
    return options;
  }
  PoseCalibration Calibrate(double noise, RefineGeometry refine) {
    images.pixels.clear();
    for (const Isometry3d& X_CB : views) {
      images.pixels.push_back(Pixels(BoardPoints(), X_CB, noise, &random));
    }
    return Calibrated(Cameras(), refine);
  }
  PoseCalibration Calibrated(const CameraOptions& cameras,
                             RefineGeometry refine) const {
    PoseCalibrationOptions options;
    options.refine = refine;
    options.folds = 0;
    return CalibratePoses(
        file, MeasurePoses("board.csv", images, file, cameras), options);
  }
  // The tool at postures near those that were photographed, in W: as the
  // calibration has it, and the true one.
  struct ToolPoses {
    std::vector<Isometry3d> found, truth;
  };
  ToolPoses NearPhotographed(const PoseCalibration& c) {
    const ArmGeometry geometry(file);
    const VectorXd values = CalibratedValues(geometry, c);
    ToolPoses poses;
    for (Eigen::Index k = 0; k < images.q.rows(); ++k) {
      const VectorXd q =
          images.q.row(k).transpose() + UniformVector(&random, 6, -.3, .3);
      poses.found.push_back(geometry.ToolPose(q, values.data(), nullptr));
      poses.truth.push_back(X_0B.inverse() * Tool(q));
    }
    return poses;
  }
  // rms of the tool's position beside the true one, m.
  double ToolError(const PoseCalibration& c) {
    const ToolPoses poses = NearPhotographed(c);
    double squares = 0;
    for (size_t k = 0; k < poses.found.size(); ++k) {
      squares += (poses.found[k].translation() - poses.truth[k].translation())
                     .squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(poses.found.size()));
  }
  // The same with other frames of camera and board: of the arm alone.
  double ArmError(const PoseCalibration& c) {
    const ToolPoses poses = NearPhotographed(c);
    const HandEye frames = *SolveHandEye(poses.found, poses.truth);
    double squares = 0;
    for (size_t k = 0; k < poses.found.size(); ++k) {
      const Isometry3d X = frames.X_WB * poses.found[k] * frames.X_ET;
      squares += (X.translation() - poses.truth[k].translation()).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(poses.found.size()));
  }

  std::mt19937_64 random;
  CameraPlace place;
  Robot file;
  VectorXd truth;
  Isometry3d X_0B = Isometry3d::Identity();
  int cameras = 1;
  Isometry3d second = Isometry3d::Identity();  // X_C1C2
  bool estimate_lens = false;
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
  IntervalCount held;
  for (int seed = 21; seed <= 30; ++seed) {
    Campaign campaign(seed, GetParam());
    campaign.Photograph(60);
    const auto exact = campaign.Calibrate(0, RefineGeometry::kAll);
    const auto noisy = campaign.Calibrate(kPixel, RefineGeometry::kAll);
    ASSERT_TRUE(exact.solved && noisy.solved);
    EXPECT_LT(exact.rms, 1e-6);
    ASSERT_EQ(exact.parameters.size(), noisy.parameters.size());
    held.AddGeometry(noisy, exact);
  }
  std::printf("%d of %d 95 %% intervals hold the truth\n", held.inside,
              held.all);
  // 95 % within three standard deviations of a count whose members are
  // correlated by about a half within a campaign.
  EXPECT_GT(held.inside, .90 * held.all);
  EXPECT_LT(held.inside, .99 * held.all);
}

Isometry3d SecondCamera() {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = RotationFromRpy({.1, .5, -.3});
  X.translation() << .1, -.03, .02;
  return X;
}

// Neither lenses nor where the second camera is are known.
Campaign TwoUnknownCameras(std::uint64_t seed, CameraPlace place) {
  Campaign campaign(seed, place);
  campaign.cameras = 2;
  campaign.second = SecondCamera();
  campaign.estimate_lens = true;
  campaign.Photograph(60);
  return campaign;
}

TEST_P(EachCamera, TwoUnknownOnesAreFoundByExactPixels) {
  Campaign campaign = TwoUnknownCameras(41, GetParam());
  const auto exact = campaign.Calibrate(0, RefineGeometry::kAll);
  ASSERT_TRUE(exact.solved) << exact.reason;
  EXPECT_LT(exact.rms, 1e-6);
  const PinholeCamera::Lens lens = HandCamera().lens();
  const bool on_tool = GetParam() == CameraPlace::kOnTool;
  // X_C2C1 of those on the tool, X_C1C2 of standing ones.
  const Isometry3d X = on_tool ? SecondCamera().inverse() : SecondCamera();
  int found = 0;
  for (const InstrumentEstimate& p : exact.instrument) {
    for (int k = 0; k < PinholeCamera::kLensSize; ++k) {
      if (p.name.substr(8) != PinholeCamera::LensName(k)) continue;
      EXPECT_NEAR(p.value, lens[k], 1e-5 * (1 + lens[k])) << p.name;
      ++found;
    }
    for (int k = 0; k < 3; ++k) {
      if (p.name != std::string("camera2.") + "xyz"[k]) continue;
      EXPECT_NEAR(p.value, X.translation()[k], 5e-6) << p.name;
      ++found;
    }
  }
  EXPECT_EQ(found, 2 * 8 + 3);
}

TEST_P(EachCamera, TwoUnknownOnesAreWithinTheirIntervals) {
  IntervalCount geometry, instrument;
  for (int seed = 51; seed <= 52; ++seed) {
    Campaign campaign = TwoUnknownCameras(seed, GetParam());
    const auto exact = campaign.Calibrate(0, RefineGeometry::kAll);
    const auto noisy = campaign.Calibrate(kPixel, RefineGeometry::kAll);
    ASSERT_TRUE(exact.solved && noisy.solved);
    ASSERT_EQ(exact.parameters.size(), noisy.parameters.size());
    geometry.AddGeometry(noisy, exact);
    for (size_t k = 0; k < exact.instrument.size(); ++k) {
      instrument.Add(noisy.instrument[k].value, exact.instrument[k].value,
                     noisy.instrument[k].stddev);
    }
  }
  std::printf("geometry %d of %d, cameras %d of %d\n", geometry.inside,
              geometry.all, instrument.inside, instrument.all);
  // As above.
  const int inside = geometry.inside + instrument.inside;
  const int all = geometry.all + instrument.all;
  EXPECT_GT(inside, .90 * all);
  EXPECT_LT(inside, .99 * all);
}

// The motion of an arm tells more of a standing camera's lens than a board
// does: one estimate of both is better than the arm's by a lens that images
// gave before. (Of a camera on the tool it tells little: both are as good.)
TEST(Cameras, AStandingOnesLensIsToldByTheArmToo) {
  double before = 0, together = 0, known = 0;
  for (int seed = 61; seed <= 64; ++seed) {
    Campaign campaign(seed, CameraPlace::kStanding);
    campaign.Photograph(60);
    const auto all = RefineGeometry::kAll;
    known += campaign.ArmError(campaign.Calibrate(kPixel, all));
    const CameraOptions lens = {{}, true, CameraPlace::kStanding};
    const auto measured =
        MeasurePoses("board.csv", campaign.images, campaign.file, lens);
    const CameraOptions given = {
        {measured.cameras[0].camera}, false, CameraPlace::kStanding};
    before += campaign.ArmError(campaign.Calibrated(given, all));
    together += campaign.ArmError(campaign.Calibrated(lens, all));
  }
  std::printf(
      "arm's error, mm: lens known %.3f, from images %.3f, together %.3f\n",
      1e3 * known / 4, 1e3 * before / 4, 1e3 * together / 4);
  EXPECT_LT(together, .8 * before);
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
