#include "model/robot_files/sdf_inertial.h"

#include <string>

#include "model/robot_files/sdf_frames.h"
#include "model/robot_files/sdf_values.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;

// The specification's values, kg and kg m^2.
constexpr double kDefaultMass = 1;
constexpr double kDefaultMoment = 1;

// About the centre of mass, in the axes of the <pose> of <inertial>.
Matrix3d ReadSdfMoments(const XmlElement& inertia) {
  const auto get = [&](const char* tag, double absent) {
    return SdfNumberOr(inertia, tag, "kg m^2", absent);
  };
  Matrix3d I;
  const double xy = get("ixy", 0), xz = get("ixz", 0), yz = get("iyz", 0);
  I << get("ixx", kDefaultMoment), xy, xz,  //
      xy, get("iyy", kDefaultMoment), yz,   //
      xz, yz, get("izz", kDefaultMoment);
  return I;
}

void NoteDefault(const std::string& lacks, const std::string& counts,
                 TreeLink* link) {
  link->notes.push_back("link " + Quoted(link->name) + " has no " + lacks +
                        ": SDF's default counts, " + counts);
}

}  // namespace

void ReadSdfInertial(const XmlElement& element, TreeLink* link) {
  const auto inertial = element.Child("inertial");
  Matrix3d I = kDefaultMoment * Matrix3d::Identity();
  if (!inertial) {
    SetInertial(kDefaultMass, I, Eigen::Isometry3d::Identity(), link);
    NoteDefault("<inertial>", "1 kg and 1 kg m^2", link);
    return;
  }
  if (!inertial->Child("mass")) NoteDefault("<mass>", "1 kg", link);
  const auto inertia = inertial->Child("inertia");
  if (inertia) {
    I = ReadSdfMoments(*inertia);
  } else {
    NoteDefault("<inertia>", "1 kg m^2", link);
  }
  SetInertial(SdfNonNegativeOr(*inertial, "mass", "kg", kDefaultMass), I,
              ReadSdfPose(*inertial), link);
}

}  // namespace armcal
