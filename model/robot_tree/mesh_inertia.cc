#include "model/robot_tree/mesh_inertia.h"

#include <Eigen/Geometry>
#include <cmath>

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Triangle {
  Vector3d a, b, c;
  Vector3d center() const { return (a + b + c) / 3; }
  // Along the normal, of twice the area.
  Vector3d normal() const { return (b - a).cross(c - a); }
  double area() const { return normal().norm() / 2; }
};

Triangle TriangleOf(const TriangleMesh& mesh, const std::array<int, 3>& corners,
                    const Vector3d& origin) {
  return {mesh.points[corners[0]] - origin, mesh.points[corners[1]] - origin,
          mesh.points[corners[2]] - origin};
}

// The centre of the surface, each triangle weighted by its area.
Vector3d SurfaceCenter(const TriangleMesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (const auto& corners : mesh.triangles) {
    const Triangle triangle = TriangleOf(mesh, corners, Vector3d::Zero());
    sum += triangle.area() * triangle.center();
    area += triangle.area();
  }
  return area > 0 ? Vector3d(sum / area) : sum;
}

// Of the pyramid from the origin over a triangle; of a shell, of the triangle.
double Weight(const Triangle& triangle, MeshVolume volume) {
  if (volume == MeshVolume::kShell) return triangle.area();
  const double pyramid = triangle.a.dot(triangle.b.cross(triangle.c)) / 6;
  return volume == MeshVolume::kAbsolute ? std::abs(pyramid) : pyramid;
}

// The integral of x x^T over the pyramid from the origin, of that volume
// (Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia tensor", J.
// Math. Stat. 1, 2004): V / 20 (sum of v v^T + s s^T), s the sum of the
// corners; of the triangle alone V / 12.
Matrix3d SecondMoment(const Triangle& t, double weight, MeshVolume volume) {
  const Vector3d s = t.a + t.b + t.c;
  const Matrix3d sum = t.a * t.a.transpose() + t.b * t.b.transpose() +
                       t.c * t.c.transpose() + s * s.transpose();
  return weight / (volume == MeshVolume::kShell ? 12 : 20) * sum;
}

}  // namespace

// As MuJoCo's compiler computes it: the centre of mass by pyramids from the
// centre of the surface, mass and moments by pyramids from the centre of mass.
// The origins matter for kAbsolute alone.
InertialParameters MeshInertia(const TriangleMesh& mesh, MeshVolume volume) {
  const Vector3d origin = SurfaceCenter(mesh);
  Vector3d sum = Vector3d::Zero();
  double total = 0;
  for (const auto& corners : mesh.triangles) {
    const Triangle triangle = TriangleOf(mesh, corners, origin);
    const double weight = Weight(triangle, volume);
    // Three quarters of the way from the tip; of a shell the sum is 0.
    sum += weight * .75 * triangle.center();
    total += weight;
  }
  if (!(total > 0)) return {};
  const Vector3d com = origin + sum / total;
  Matrix3d second = Matrix3d::Zero();
  double mass = 0;
  for (const auto& corners : mesh.triangles) {
    const Triangle triangle = TriangleOf(mesh, corners, com);
    const double weight = Weight(triangle, volume);
    second += SecondMoment(triangle, weight, volume);
    mass += weight;
  }
  if (!(mass > 0)) return {};
  InertialParameters V = InertialParameters::FromCenterOfMass(
      mass, Vector3d::Zero(),
      Matrix3d(second.trace() * Matrix3d::Identity() - second));
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translation() = com;
  return V.ReexpressIn(X);
}

}  // namespace armcal
