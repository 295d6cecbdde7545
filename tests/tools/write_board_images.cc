// Writes what a command test of cameras needs to a folder: a UR5 as ur5.urdf,
// whose true joints' zeros are 3 mrad off, and board.csv, what two cameras on
// its tool saw of a standing board.

#include <fstream>
#include <iomanip>

#include "calib/poses/cameras/image_view.h"
#include "model/robot/arm_geometry.h"
#include "model/robot/rotations.h"
#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/board_camera.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/solved_posture.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::VectorXd;

Isometry3d Frame(double x, double y, double z, const Eigen::Vector3d& rpy) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = RotationFromRpy(rpy);
  X.translation() << x, y, z;
  return X;
}

class Photographs {
 public:
  explicit Photographs(const Robot& file) : geometry_(file) {
    truth_ = geometry_.Values();
    const auto names = geometry_.Names();
    for (int k = 6; k + 6 < geometry_.size(); ++k) {
      const bool zero = names[k].find(".theta") != std::string::npos;
      if (zero) truth_[k] += 3e-3 * Normal(&random_);
    }
    truth_.tail<6>() << .03, -.05, .08, .4, -.05, .1;
  }
  // Rows of an image that camera 0 or 1 takes somewhere before the board.
  void Write(int image, int camera, std::ostream* out) {
    const Isometry3d second = Frame(.1, -.03, .02, {.1, .5, -.3});
    std::optional<VectorXd> q;
    Isometry3d X_CB;
    while (!q) {
      X_CB = RandomView(&random_);
      const Isometry3d X_0T =
          Frame(-.55, .1, .05, {.05, .02, .3}) * X_CB.inverse() *
          (camera == 0 ? Isometry3d::Identity() : second.inverse());
      q = SolvedPosture(
          [&](const VectorXd& at) {
            return FrameError(X_0T.inverse() *
                              geometry_.ToolPose(at, truth_.data(), nullptr));
          },
          UniformVector(&random_, 6, -2, 2));
    }
    const Eigen::Matrix3Xd points = BoardPoints();
    const Eigen::Matrix2Xd pixels = Pixels(points, X_CB, kPixel, &random_);
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      *out << image << "," << camera + 1;
      for (const double angle : *q) *out << "," << angle;
      *out << "," << points(0, k) << "," << points(1, k) << "," << pixels(0, k)
           << "," << pixels(1, k) << "\n";
    }
  }

 private:
  ArmGeometry geometry_;
  VectorXd truth_;
  std::mt19937_64 random_{8};
};

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  using namespace armcal;
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  Robot robot = SampleRobot("UR5 6R");
  robot.name = "ur5";
  std::ofstream(folder + "/ur5.urdf") << MakeUrdf(robot);
  std::ofstream board(folder + "/board.csv");
  board << std::setprecision(12)
        << "image,camera,q1,q2,q3,q4,q5,q6,bx,by,u,v\n";
  Photographs photographs(robot);
  for (int image = 1; image <= 50; ++image) {
    photographs.Write(image, image % 2, &board);
  }
}
