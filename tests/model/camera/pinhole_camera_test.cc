#include "model/camera/pinhole_camera.h"

#include <gtest/gtest.h>

#include "model/camera/camera_file.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::pinhole_camera_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

const PinholeCamera kCamera = {900, 905,   640,    360, -.12,
                               .05, .0008, -.0005, .01};

// By projectPoints of OpenCV 4.11 for the same camera.
TEST(PinholeCamera, SeesWhatOpenCvDoes) {
  const struct {
    Vector3d point;
    Vector2d pixel;
  } kSeen[] = {{{.1, -.2, .8}, {751.3859624671936, 135.97631263542178}},
               {{-.3, .25, .7}, {266.1808941556482, 673.3545345080835}},
               {{.02, .01, 1.5}, {651.999548029631, 366.0333172593422}}};
  for (const auto& seen : kSeen) {
    EXPECT_LT((kCamera.Project(seen.point, nullptr) - seen.pixel).norm(), 1e-9);
  }
}

TEST(PinholeCamera, DerivativesAreThoseOfDifferences) {
  const Vector3d p(-.3, .25, .7);
  Eigen::Matrix<double, 2, 3> by_point;
  kCamera.Project(p, &by_point);
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Vector3d step = kStep * Vector3d::Unit(k);
    const Vector2d slope = (kCamera.Project(p + step, nullptr) -
                            kCamera.Project(p - step, nullptr)) /
                           (2 * kStep);
    EXPECT_LT((slope - by_point.col(k)).norm(), 1e-5 * slope.norm());
  }
}

TEST(PinholeCamera, DerivativesByTheLensAreThoseOfDifferences) {
  const Vector3d p(-.3, .25, .7);
  PinholeCamera::ByLens by_lens;
  kCamera.Project(p, nullptr, &by_lens);
  for (int k = 0; k < PinholeCamera::kLensSize; ++k) {
    PinholeCamera::Lens lens = kCamera.lens();
    PinholeCamera moved = kCamera;
    lens[k] += 1e-3;
    moved.set_lens(lens);
    // u and v are linear in each.
    const Vector2d slope =
        (moved.Project(p, nullptr) - kCamera.Project(p, nullptr)) / 1e-3;
    EXPECT_LT((slope - by_lens.col(k)).norm(), 1e-9 * (1 + slope.norm()))
        << PinholeCamera::LensName(k);
  }
}

TEST(PinholeCamera, DirectionsAreWithoutTheLens) {
  const Vector3d p(-.3, .25, .7);
  const Vector2d xy = kCamera.Normalised(kCamera.Project(p, nullptr));
  EXPECT_NEAR(xy.x(), -.3 / .7, 1e-12);
  EXPECT_NEAR(xy.y(), .25 / .7, 1e-12);
}

constexpr char kFile[] =
    "image_width: 1280\nimage_height: 720\ncamera_name: hand\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n"
    "  data: [900, 0, 640, 0, 905, 360, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n"
    "  data: [-0.12, 0.05, 0.0008, -0.0005, 0.01]\n";

TEST(CameraFile, IsReadAsRosWritesIt) {
  const PinholeCamera camera = ReadCamera(WriteFile(kFile, "camera.yaml"));
  const Vector3d p(.1, -.2, .8);
  EXPECT_EQ(camera.Project(p, nullptr), kCamera.Project(p, nullptr));
}

TEST(CameraFile, OtherCamerasAreRefused) {
  const auto message = [](const std::string& from, const std::string& to) {
    std::string text = kFile;
    text.replace(text.find(from), from.size(), to);
    const std::string path = WriteFile(text, "camera.yaml");
    return MessageOf<InputError>(path, [&] { ReadCamera(path); });
  };
  EXPECT_EQ(message("plumb_bob", "rational_polynomial"),
            "FILE: line 8, distortion_model: found 'rational_polynomial': "
            "expected one of plumb_bob");
  EXPECT_NE(message("900, 0, 640", "900, 1, 640").find("expected data"),
            std::string::npos);
  EXPECT_NE(message("[-0.12, 0.05,", "[-0.12,").find("Camera"), 0u);
}

TEST(CameraFile, IsWrittenAsItIsRead) {
  PinholeCamera camera = kCamera;
  camera.width = 1280;
  camera.height = 720;
  const PinholeCamera read =
      ReadCamera(WriteFile(CameraYaml(camera, "hand"), "camera.yaml"));
  EXPECT_TRUE(read.lens().isApprox(camera.lens(), 1e-11));
  EXPECT_NEAR(read.k3, camera.k3, 1e-12);
  EXPECT_EQ(read.width, 1280);
  EXPECT_EQ(read.height, 720);
}

}  // namespace armcal::pinhole_camera_test
