#include "model/robot_files/mjcf/mjcf_geom.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/robot_files/mjcf/mjcf_pose.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Half sizes, or radius and half length along z.
struct GeomShape {
  std::string type;
  Vector3d size = Vector3d::Zero();  // m
  Isometry3d X_BG = Isometry3d::Identity();
};

int NumSizes(const std::string& type) {
  if (type == "sphere") return 1;
  return type == "box" || type == "ellipsoid" ? 3 : 2;
}

void ReadSize(const MjcfElement& geom, int count, GeomShape* shape) {
  const XmlElement& holder = geom.HolderOf("size");
  if (!holder.Has("size"))
    holder.Refuse("", "", "expected an attribute 'size'");
  // More numbers than the type needs are allowed.
  const std::string text = holder.Text("size");
  const int given = static_cast<int>(SplitWords(text).size());
  holder.Numbers("size", std::clamp(given, count, 3), "m", shape->size.data());
  if ((shape->size.head(count).array() <= 0).any()) {
    holder.Refuse("size", text, "expected sizes in m that are positive");
  }
}

// From one end to the other: the axis is z, and size has the radius only.
void ReadEnds(const MjcfElement& geom, GeomShape* shape) {
  const XmlElement& holder = geom.HolderOf("fromto");
  double v[6];
  holder.Numbers("fromto", 6, "m", v);
  const Vector3d from(v[0], v[1], v[2]), to(v[3], v[4], v[5]);
  const double length = (to - from).norm();
  if (length < 1e-10 || shape->type == "sphere") {
    holder.Refuse("fromto", holder.Text("fromto"),
                  "expected two points apart, of a shape with a length");
  }
  ReadSize(geom, 1, shape);
  const double radius = shape->size[0];
  shape->size = NumSizes(shape->type) == 3
                    ? Vector3d(radius, radius, length / 2)
                    : Vector3d(radius, length / 2, 0);
  shape->X_BG.translation() = (from + to) / 2;
  shape->X_BG.linear() = RotationOfZ((to - from) / length);
}

double Volume(const GeomShape& shape) {
  const Vector3d& s = shape.size;
  const double ball = 4 * M_PI / 3, disc = M_PI * s[0] * s[0];
  if (shape.type == "sphere") return ball * s[0] * s[0] * s[0];
  if (shape.type == "capsule")
    return disc * 2 * s[1] + ball * std::pow(s[0], 3);
  if (shape.type == "cylinder") return disc * 2 * s[1];
  return s.prod() * (shape.type == "box" ? 8 : ball);
}

// Half balls at the ends of a cylinder.
Vector3d CapsuleInertia(double mass, double r, double height) {
  const double balls = mass * 4 * r / (4 * r + 3 * height);
  const double cylinder = mass - balls;
  const double across =
      cylinder * (3 * r * r + height * height) / 12 +
      balls * (2 * r * r / 5 + height * (3 * r + 2 * height) / 8);
  const double along = cylinder * r * r / 2 + balls * 2 * r * r / 5;
  return {across, across, along};
}

// Principal moments about the centre, kg m^2.
Vector3d Inertia(const GeomShape& shape, double mass) {
  const Vector3d& s = shape.size;
  const Vector3d squares = s.cwiseAbs2();
  const Vector3d others(squares[1] + squares[2], squares[0] + squares[2],
                        squares[0] + squares[1]);
  if (shape.type == "sphere") return Vector3d::Constant(.4 * mass * squares[0]);
  if (shape.type == "capsule") return CapsuleInertia(mass, s[0], 2 * s[1]);
  if (shape.type == "cylinder") {
    const double across = mass * (3 * squares[0] + 4 * squares[1]) / 12;
    return {across, across, mass * squares[0] / 2};
  }
  return others * mass / (shape.type == "box" ? 3 : 5);
}

bool IsMassless(const MjcfElement& geom, const MjcfSettings& settings) {
  const double group = geom.NumberOr("group", "", 0);
  return group < settings.inertia_groups[0] ||
         group > settings.inertia_groups[1] ||
         (geom.Has("mass") ? geom.NonNegativeOr0("mass", "kg") == 0
                           : geom.NumberOr("density", "kg/m^3", 1000) == 0);
}

InertialParameters MeshGeom(const MjcfElement& geom,
                            const MjcfSettings& settings, MjcfMeshes* meshes) {
  InertialParameters V = meshes->Body(geom);
  const double density = geom.Has("mass")
                             ? geom.NonNegativeOr0("mass", "kg") / V.mass
                             : geom.NumberOr("density", "", 1000);
  V.mass *= density;
  V.first_moment *= density;
  V.inertia *= density;
  return V.ReexpressIn(ReadMjcfPose(geom, settings));
}

}  // namespace

InertialParameters ReadMjcfGeom(const MjcfElement& geom,
                                const MjcfSettings& settings,
                                MjcfMeshes* meshes) {
  GeomShape shape;
  shape.type =
      geom.Choice("type", {"sphere", "capsule", "cylinder", "box", "ellipsoid",
                           "plane", "mesh", "hfield", "sdf"});
  if (shape.type == "plane" || IsMassless(geom, settings)) return {};
  if (shape.type == "mesh") return MeshGeom(geom, settings, meshes);
  if (shape.type == "hfield" || shape.type == "sdf" || geom.Has("mesh")) {
    geom.own().Refuse("", shape.type,
                      "expected an <inertial> of the body: armcal does not "
                      "compute this geom's shape");
  }
  if (geom.Text("shellinertia") == "true") {
    geom.HolderOf("shellinertia")
        .Refuse("shellinertia", "true", "expected solid geoms");
  }
  if (geom.Has("fromto")) {
    ReadEnds(geom, &shape);
  } else {
    ReadSize(geom, NumSizes(shape.type), &shape);
    shape.X_BG = ReadMjcfPose(geom, settings);
  }
  const double mass = geom.Has("mass")
                          ? geom.NonNegativeOr0("mass", "kg")
                          : Volume(shape) * geom.NumberOr("density", "", 1000);
  return InertialParameters::FromCenterOfMass(
             mass, Vector3d::Zero(),
             Matrix3d(Inertia(shape, mass).asDiagonal()))
      .ReexpressIn(shape.X_BG);
}

}  // namespace armcal
