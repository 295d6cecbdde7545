#include "model/robot_files/mjcf/mjcf_inertial.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "model/robot_files/mjcf/mjcf_geom.h"
#include "model/robot_files/mjcf/mjcf_pose.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using FromGeoms = MjcfSettings::FromGeoms;

// In the frame of the <inertial>.
Matrix3d ReadMoments(const XmlElement& inertial) {
  Matrix3d I = Matrix3d::Zero();
  if (!inertial.Has("fullinertia")) {
    I.diagonal() = inertial.Vector("diaginertia", "kg m^2");
  } else {
    double v[6];  // xx yy zz xy xz yz
    inertial.Numbers("fullinertia", 6, "kg m^2", v);
    I << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
    for (const char* other :
         {"diaginertia", "quat", "axisangle", "euler", "xyaxes", "zaxis"}) {
      if (!inertial.Has(other)) continue;
      inertial.Refuse(other, inertial.Text(other),
                      "expected none beside fullinertia, which is in the "
                      "body's axes");
    }
  }
  if ((I.diagonal().array() < 0).any()) {
    const char* name =
        inertial.Has("fullinertia") ? "fullinertia" : "diaginertia";
    inertial.Refuse(name, inertial.Text(name),
                    "expected moments in kg m^2 that are not negative");
  }
  return I;
}

// What MuJoCo's compiler makes of each body: raises its mass and principal
// moments to bounds, and gives moments that no body has their mean. A body
// without mass gets it at `p`.
void ApplyBounds(const MjcfSettings& settings, const Vector3d& p,
                 TreeLink* link) {
  if (settings.boundmass <= 0 && settings.boundinertia <= 0 &&
      !settings.balanceinertia) {
    return;
  }
  InertialParameters& V = link->inertial;
  const Vector3d com = V.mass > 0 ? Vector3d(V.first_moment / V.mass) : p;
  const Matrix3d about_com =
      V.inertia - V.mass * (com.squaredNorm() * Matrix3d::Identity() -
                            com * com.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(about_com);
  Vector3d moments = axes.eigenvalues().cwiseMax(settings.boundinertia);
  if (settings.balanceinertia && moments[0] + moments[1] < moments[2]) {
    moments.setConstant(moments.mean());
  }
  const double mass = std::max(V.mass, settings.boundmass);
  const Matrix3d& R = axes.eigenvectors();
  V = InertialParameters::FromCenterOfMass(
      mass, com, R * moments.asDiagonal() * R.transpose());
  link->has_inertial = mass > 0;
}

void ReadGiven(const XmlElement& inertial, const MjcfSettings& settings,
               TreeLink* link) {
  const double mass = inertial.NonNegative("mass", "kg");
  inertial.Vector("pos", "m");  // required
  const Isometry3d X_LI = ReadMjcfPose(MjcfElement({inertial}), settings);
  const Matrix3d I = ReadMoments(inertial);
  SetInertial(mass, I, X_LI, link);
}

void ReadGeoms(const std::vector<MjcfPart>& parts, const MjcfDefaults& defaults,
               const MjcfSettings& settings, MjcfMeshes* meshes,
               TreeLink* link) {
  InertialParameters total;
  for (const MjcfPart& part : parts) {
    if (part.element.tag() != "geom") continue;
    const MjcfElement geom = defaults.Of(part.element, part.childclass);
    total += ReadMjcfGeom(geom, settings, meshes).ReexpressIn(part.X_BF);
  }
  if (total.mass == 0) return;
  link->inertial = total;
  link->has_inertial = true;
}

const XmlElement* FindInertial(const std::vector<MjcfPart>& parts) {
  const XmlElement* found = nullptr;
  for (const MjcfPart& part : parts) {
    if (part.element.tag() != "inertial") continue;
    if (found != nullptr) {
      part.element.Refuse("", "", "expected only one <inertial> element");
    }
    found = &part.element;
  }
  return found;
}

}  // namespace

void ReadMjcfInertial(const XmlElement& body,
                      const std::vector<MjcfPart>& parts,
                      const MjcfDefaults& defaults,
                      const MjcfSettings& settings, MjcfMeshes* meshes,
                      TreeLink* link) {
  const XmlElement* inertial = FindInertial(parts);
  const FromGeoms source = settings.inertia_from_geoms;
  if (inertial != nullptr && source != FromGeoms::kAlways) {
    ReadGiven(*inertial, settings, link);
  } else if (source != FromGeoms::kNever) {
    ReadGeoms(parts, defaults, settings, meshes, link);
  }
  // MuJoCo (4.0.0, and 2.2.2) puts the inertia of a body that says none where
  // `pos` puts the body on its parent, as numbers of the body's own frame.
  const XmlElement& says = inertial != nullptr ? *inertial : body;
  ApplyBounds(settings,
              MjcfElement({says}).VectorOr("pos", "m", Vector3d::Zero()), link);
}

}  // namespace armcal
