#include "model/camera/camera_file.h"

#include <optional>

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
  ReadLens(root, &camera);
  return camera;
}

}  // namespace armcal
