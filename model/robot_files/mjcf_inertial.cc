#include "model/robot_files/mjcf_inertial.h"

#include <Eigen/Eigenvalues>

#include "model/robot_files/mjcf_geom.h"
#include "model/robot_files/mjcf_pose.h"

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

// MuJoCo's compiler would change such a body.
void RefuseChanges(const XmlElement& inertial, double mass, const Matrix3d& I,
                   const MjcfSettings& settings) {
  const Vector3d moments = I.selfadjointView<Eigen::Lower>().eigenvalues();
  if (mass < settings.boundmass) {
    inertial.Refuse("mass", inertial.Text("mass"),
                    "expected at least the compiler's boundmass");
  }
  if (moments[0] < settings.boundinertia) {
    inertial.Refuse("", "",
                    "expected moments of inertia of at least the "
                    "compiler's boundinertia");
  }
  if (settings.balanceinertia && moments[0] + moments[1] < moments[2]) {
    inertial.Refuse("", "",
                    "expected an inertia that a body can have: balanceinertia "
                    "would change it");
  }
}

void ReadGiven(const XmlElement& inertial, const MjcfSettings& settings,
               TreeLink* link) {
  const double mass = inertial.NonNegative("mass", "kg");
  inertial.Vector("pos", "m");  // required
  const Isometry3d X_LI = ReadMjcfPose(MjcfElement({inertial}), settings);
  const Matrix3d I = ReadMoments(inertial);
  RefuseChanges(inertial, mass, I, settings);
  SetInertial(mass, I, X_LI, link);
}

void ReadGeoms(const XmlElement& body, const std::string& childclass,
               const MjcfDefaults& defaults, const MjcfSettings& settings,
               TreeLink* link) {
  InertialParameters total;
  try {
    for (const XmlElement& geom : body.Children("geom")) {
      total += ReadMjcfGeom(defaults.Of(geom, childclass), settings);
    }
  } catch (const InputError& error) {
    link->inertial_error = error;
    return;
  }
  if (total.mass == 0) return;
  link->inertial = total;
  link->has_inertial = true;
}

}  // namespace

void ReadMjcfInertial(const XmlElement& body, const std::string& childclass,
                      const MjcfDefaults& defaults,
                      const MjcfSettings& settings, TreeLink* link) {
  const std::optional<XmlElement> inertial = body.Child("inertial");
  const FromGeoms source = settings.inertia_from_geoms;
  if (inertial && source != FromGeoms::kAlways) {
    ReadGiven(*inertial, settings, link);
  } else if (source != FromGeoms::kNever) {
    ReadGeoms(body, childclass, defaults, settings, link);
  }
}

}  // namespace armcal
