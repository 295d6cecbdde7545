#include "model/camera/camera_file.h"

#include <optional>
#include <sstream>

#include "model/text/yaml_node.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// The numbers of {rows, cols, data: [..]}.
VectorXd MatrixData(const YamlNode& root, const std::string& key) {
  return root.RequiredChild(key).RequiredChild("data").Vector("");
}

void ReadLens(const YamlNode& root, PinholeCamera* camera) {
  if (const std::optional<YamlNode> model = root.Child("distortion_model")) {
    model->Choice({"plumb_bob"});
  }
  if (!root.Child("distortion_coefficients")) return;
  const VectorXd d = MatrixData(root, "distortion_coefficients");
  if (d.size() != 0 && d.size() != 4 && d.size() != 5) {
    root.RequiredChild("distortion_coefficients")
        .Refuse("expected k1 k2 p1 p2 and perhaps k3");
  }
  if (d.size() == 0) return;
  camera->k1 = d[0];
  camera->k2 = d[1];
  camera->p1 = d[2];
  camera->p2 = d[3];
  if (d.size() == 5) camera->k3 = d[4];
}

}  // namespace

PinholeCamera ReadCamera(const std::string& path) {
  const YamlNode root = YamlNode::ReadFile(path);
  root.ExpectKeys({"image_width", "image_height", "camera_name",
                   "camera_matrix", "distortion_model",
                   "distortion_coefficients", "rectification_matrix",
                   "projection_matrix"});
  const VectorXd K = MatrixData(root, "camera_matrix");
  const bool is_pinhole = K.size() == 9 && K[0] > 0 && K[4] > 0 && K[1] == 0 &&
                          K[3] == 0 && K[6] == 0 && K[7] == 0 && K[8] == 1;
  if (!is_pinhole) {
    root.RequiredChild("camera_matrix")
        .Refuse("expected data: [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  }
  PinholeCamera camera;
  camera.fx = K[0];
  camera.cx = K[2];
  camera.fy = K[4];
  camera.cy = K[5];
  if (const auto width = root.Child("image_width")) {
    camera.width = static_cast<int>(width->NonNegative("px"));
  }
  if (const auto height = root.Child("image_height")) {
    camera.height = static_cast<int>(height->NonNegative("px"));
  }
  ReadLens(root, &camera);
  return camera;
}

std::string CameraYaml(const PinholeCamera& c, const std::string& name) {
  std::ostringstream text;
  text.precision(12);
  if (c.width > 0 && c.height > 0) {
    text << "image_width: " << c.width << "\nimage_height: " << c.height
         << "\n";
  }
  text << "camera_name: " << name
       << "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [" << c.fx << ", 0, "
       << c.cx << ", 0, " << c.fy << ", " << c.cy
       << ", 0, 0, 1]\ndistortion_model: plumb_bob\n"
          "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: ["
       << c.k1 << ", " << c.k2 << ", " << c.p1 << ", " << c.p2 << ", " << c.k3
       << "]\n";
  return text.str();
}

}  // namespace armcal
