#include "model/robot_files/mjcf/mjcf_meshes.h"

#include <filesystem>
#include <system_error>

#include "model/robot_tree/mesh_inertia.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr long kMostBytesOfMeshes = 512L << 20;  // of all meshes together

MeshVolume VolumeOf(const MjcfElement& mesh) {
  const std::string how =
      mesh.Choice("inertia", {"legacy", "exact", "convex", "shell"});
  if (how == "convex") {
    mesh.HolderOf("inertia").Refuse(
        "inertia", how,
        "expected legacy, exact or shell, or an <inertial> of the body: armcal "
        "computes no convex hulls");
  }
  return how == "exact"   ? MeshVolume::kExact
         : how == "shell" ? MeshVolume::kShell
                          : MeshVolume::kAbsolute;
}

// The points as the asset moves, turns and stretches them.
void Place(const MjcfElement& mesh, TriangleMesh* shape) {
  const Vector3d scale = mesh.VectorOr("scale", "", Vector3d::Ones());
  const Vector3d shift = mesh.VectorOr("refpos", "m", Vector3d::Zero());
  double q[4] = {1, 0, 0, 0};
  if (mesh.Has("refquat"))
    mesh.HolderOf("refquat").Numbers("refquat", 4, "", q);
  const Eigen::Matrix3d R = Eigen::Quaterniond(q[0], q[1], q[2], q[3])
                                .normalized()
                                .toRotationMatrix();
  for (Vector3d& point : shape->points) {
    point = scale.cwiseProduct(R.transpose() * (point - shift));
  }
  // A mirrored shape has its outside within.
  if (scale.prod() >= 0) return;
  for (auto& corners : shape->triangles) std::swap(corners[0], corners[1]);
}

}  // namespace

MjcfMeshes::MjcfMeshes(const XmlElement& root, const MjcfDefaults& defaults,
                       const ModelFolder& folder)
    : folder_(folder) {
  for (const XmlElement& compiler : root.Children("compiler")) {
    if (compiler.Has("assetdir")) directory_ = compiler.Text("assetdir");
    if (compiler.Has("strippath")) {
      strip_path_ = compiler.Text("strippath") == "true";
    }
  }
  for (const XmlElement& compiler : root.Children("compiler")) {
    if (compiler.Has("meshdir")) directory_ = compiler.Text("meshdir");
  }
  for (const XmlElement& section : root.Children("asset")) {
    for (const XmlElement& mesh : section.Children("mesh")) {
      const std::string file = mesh.Has("file") ? mesh.Text("file") : "";
      const std::string name =
          mesh.Has("name") ? mesh.Text("name") : fs::path(file).stem().string();
      meshes_.emplace(name, defaults.Of(mesh, ""));
    }
  }
}

InertialParameters MjcfMeshes::Read(const MjcfElement& mesh) {
  const XmlElement& element = mesh.own();
  if (!element.Has("file")) {
    element.Refuse("", "",
                   "expected an <inertial> of the body, or a mesh with "
                   "an attribute 'file'");
  }
  const fs::path named = element.Text("file");
  const fs::path path = folder_.Find(
      element, "file",
      fs::path(directory_) / (strip_path_ ? named.filename() : named), "");
  std::error_code error;
  bytes_ += static_cast<long>(fs::file_size(path, error));
  if (bytes_ > kMostBytesOfMeshes) {
    element.Refuse("file", named.string(),
                   "expected meshes of together at most " +
                       std::to_string(kMostBytesOfMeshes >> 20) + " MiB");
  }
  TriangleMesh shape = ReadMeshFile(path);
  read_.push_back(named.string());
  Place(mesh, &shape);
  const InertialParameters body = MeshInertia(shape, VolumeOf(mesh));
  if (body.mass > 0) return body;
  element.Refuse("file", named.string(),
                 "expected a surface that encloses a volume");
}

InertialParameters MjcfMeshes::Body(const MjcfElement& geom) {
  const std::string name = geom.Text("mesh");
  const auto mesh = meshes_.find(name);
  if (mesh == meshes_.end()) {
    geom.own().Refuse("mesh", name, "expected a mesh of the file's <asset>");
  }
  const auto known = bodies_.find(name);
  if (known != bodies_.end()) return known->second;
  return bodies_.emplace(name, Read(mesh->second)).first->second;
}

}  // namespace armcal
