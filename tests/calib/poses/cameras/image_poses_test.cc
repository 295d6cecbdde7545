#include "calib/poses/cameras/image_poses.h"

#include <gtest/gtest.h>

#include "model/text/input_error.h"
#include "tests/fixtures/board_camera.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::image_poses_test {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Views {
  Views(int count, bool flat, double noise, std::mt19937_64* random) {
    images.q = Eigen::MatrixXd::Zero(count, 6);
    for (int k = 0; k < count; ++k) {
      X_CB.push_back(RandomView(random));
      images.row.push_back(2 + 54 * k);
      images.number.push_back(k + 1);
      images.camera.push_back(0);
      images.points.push_back(BoardPoints(flat));
      images.pixels.push_back(Pixels(images.points[k], X_CB[k], noise, random));
    }
  }
  PoseMeasurements Measure(CameraPlace place) const {
    return MeasurePoses("board.csv", images, SampleRobot("UR5 6R"),
                        {{HandCamera()}, false, place});
  }
  Isometry3d Truth(CameraPlace place, int k) const {
    return place == CameraPlace::kStanding ? X_CB[k] : X_CB[k].inverse();
  }

  BoardImages images;
  std::vector<Isometry3d> X_CB;
};

// Of a measured pose against the true one: position and rotation, in W.
Eigen::Matrix<double, 6, 1> ErrorOf(const PoseMeasurements& measured, int k,
                                    const Isometry3d& truth) {
  const Eigen::RowVectorXd m = measured.poses.row(k);
  const Eigen::AngleAxisd turn(
      Eigen::Quaterniond(m[3], m[4], m[5], m[6]).matrix() *
      truth.linear().transpose());
  Eigen::Matrix<double, 6, 1> error;
  error << m.head<3>().transpose() - truth.translation(),
      turn.angle() * turn.axis();
  return error;
}

Matrix6d Whitening(const PoseMeasurements& measured, int k) {
  return measured.covariance[k].llt().matrixL().solve(Matrix6d::Identity());
}

class EachPlace : public testing::TestWithParam<CameraPlace> {};
INSTANTIATE_TEST_SUITE_P(Cameras, EachPlace,
                         testing::Values(CameraPlace::kOnTool,
                                         CameraPlace::kStanding));

TEST_P(EachPlace, ExactPixelsGiveExactPoses) {
  for (const bool flat : {true, false}) {
    std::mt19937_64 random(1);
    const Views views(10, flat, 0, &random);
    const PoseMeasurements measured = views.Measure(GetParam());
    for (int k = 0; k < 10; ++k) {
      EXPECT_LT(ErrorOf(measured, k, views.Truth(GetParam(), k)).norm(), 1e-8);
    }
  }
}

// Of a lens that is not known: from the closed form, which has no distortion.
TEST_P(EachPlace, ExactPixelsGiveTheLens) {
  std::mt19937_64 random(5);
  const Views views(20, true, 0, &random);
  const PoseMeasurements measured = MeasurePoses(
      "board.csv", views.images, SampleRobot("UR5 6R"), {{}, true, GetParam()});
  const PinholeCamera::Lens truth = HandCamera().lens();
  for (int k = 0; k < PinholeCamera::kLensSize; ++k) {
    EXPECT_NEAR(measured.instrument.start[k], truth[k], 1e-6 * (1 + truth[k]))
        << PinholeCamera::LensName(k);
  }
  for (int k = 0; k < 20; ++k) {
    EXPECT_LT(ErrorOf(measured, k, views.Truth(GetParam(), k)).norm(), 1e-7);
  }
}

// The lens within its covariance, and poses with it moved to the true one
// within theirs.
TEST_P(EachPlace, NoisyPixelsGiveTheLensWithinItsCovariance) {
  double lens_squares = 0, pose_squares = 0;
  constexpr int kCampaigns = 30, kViews = 15;
  for (int seed = 1; seed <= kCampaigns; ++seed) {
    std::mt19937_64 random(100 + seed);
    const Views views(kViews, true, kPixel, &random);
    const PoseMeasurements measured =
        MeasurePoses("board.csv", views.images, SampleRobot("UR5 6R"),
                     {{}, true, GetParam()});
    const InstrumentUnknowns& unknowns = measured.instrument;
    const Eigen::VectorXd truth =
        unknowns.by_unknowns.colPivHouseholderQr().solve(HandCamera().lens() -
                                                         unknowns.start);
    lens_squares += truth.squaredNorm();
    for (int k = 0; k < kViews; ++k) {
      pose_squares += (Whitening(measured, k) *
                       (ErrorOf(measured, k, views.Truth(GetParam(), k)) +
                        unknowns.moves[k] * truth))
                          .squaredNorm();
    }
  }
  // chi^2 of 8 and of 6 in each campaign or image; three deviations of their
  // means.
  const double lens = lens_squares / kCampaigns / 8;
  const double poses = pose_squares / kCampaigns / kViews / 6;
  std::printf("mean squares: lens %.2f, poses %.2f\n", lens, poses);
  EXPECT_NEAR(lens, 1, 3 * std::sqrt(2. / 8 / kCampaigns));
  EXPECT_NEAR(poses, 1, 3 * std::sqrt(2. / 6 / kCampaigns / kViews) + .05);
}

// From one side a nearer board and a shorter lens are alike.
TEST(ImagePoses, ImagesThatDoNotTellTheLensAreRefused) {
  std::mt19937_64 random(6);
  Views views(8, true, kPixel, &random);
  for (int k = 0; k < 8; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = Eigen::AngleAxisd(M_PI, Vector3d::UnitX()).matrix();
    X.translation() << -.1 + .01 * k, .06, .5;
    views.images.pixels[k] = Pixels(BoardPoints(), X, kPixel, &random);
  }
  const std::string message = MessageOf<InputError>("board.csv", [&] {
    MeasurePoses("board.csv", views.images, SampleRobot("UR5 6R"),
                 {{}, true, CameraPlace::kStanding});
  });
  EXPECT_NE(message.find("do not tell the camera's lens"), std::string::npos)
      << message;
}

// Whitened errors of 200 poses: their squares are chi squared of 6.
TEST_P(EachPlace, ErrorsAreAsLargeAsTheirCovarianceSays) {
  constexpr int kViews = 200;
  std::mt19937_64 random(2);
  const Views views(kViews, true, kPixel, &random);
  const PoseMeasurements measured = views.Measure(GetParam());
  EXPECT_NEAR(measured.pixel_stddev, kPixel, .03 * kPixel);
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  for (int k = 0; k < kViews; ++k) {
    squares += (Whitening(measured, k) *
                ErrorOf(measured, k, views.Truth(GetParam(), k)))
                   .cwiseAbs2();
  }
  // Standard deviation of a mean of squares: sqrt(2 / 200).
  for (const double mean : squares / kViews) EXPECT_NEAR(mean, 1, .4);
  EXPECT_NEAR(squares.sum() / kViews / 6, 1, .15);
}

// One corner that is 40 px off pulls as one that is 0.4 px off would, by
// Huber's weight; by plain least squares it would be a hundred times that.
TEST(ImagePoses, OneWrongCornerIsOutweighed) {
  const auto moved_by = [](double wrong) {
    std::mt19937_64 random(3);
    Views views(20, true, kPixel, &random);
    const auto clean = views.Measure(CameraPlace::kStanding);
    views.images.pixels[4](0, 11) += wrong;
    const auto after = views.Measure(CameraPlace::kStanding);
    const Isometry3d truth = views.Truth(CameraPlace::kStanding, 4);
    return (Whitening(clean, 4) *
            (ErrorOf(after, 4, truth) - ErrorOf(clean, 4, truth)))
        .norm();
  };
  EXPECT_LT(moved_by(40), 3 * moved_by(.8));
}

TEST(ImagePoses, PointsOnALineAreRefused) {
  std::mt19937_64 random(4);
  Views views(3, true, 0, &random);
  for (int k = 0; k < 54; ++k) views.images.points[1].col(k) << .01 * k, 0, 0;
  EXPECT_EQ(MessageOf<InputError>("board.csv",
                                  [&] { views.Measure(CameraPlace::kOnTool); }),
            "FILE: row 56: the points of this image do not tell where the "
            "board is: expected four or more that are not on a line");
}

}  // namespace armcal::image_poses_test
