#include "calib/inspect/robot_audit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "model/robot/kinematics.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// About the centre of mass, kg m^2.
Matrix3d CentralInertia(const InertialParameters& body) {
  const Vector3d c = body.first_moment / body.mass;
  return body.inertia - body.mass * (c.squaredNorm() * Matrix3d::Identity() -
                                     c * c.transpose());
}

// m
double RadiusOfGyration(const InertialParameters& body) {
  return std::sqrt(std::abs(CentralInertia(body).trace()) / 2 / body.mass);
}

// Of all bodies of one mass that are nowhere denser than rho the ball has the
// least moment about its centre, m k^2 = 3/5 m r^2 with m = 4/3 pi r^3 rho:
// m / k^3 is 9.01 rho of it and less of all others. Nothing solid is denser
// than osmium, 22590 kg/m^3 (Arblaster, Platinum Metals Rev. 33 (1989) 14).
bool IsTooDense(const InertialParameters& body) {
  constexpr double kDensest = 9.01 * 22590;  // kg/m^3
  const double radius = RadiusOfGyration(body);
  return radius > 0 && body.mass > kDensest * radius * radius * radius;
}

// The longest distance between neighbouring joints and the tool, m.
double LongestLink(const Robot& robot) {
  double longest = 0;
  const std::vector<Eigen::Isometry3d> X_WL =
      LinkPoses(robot, Eigen::VectorXd::Zero(robot.num_joints()));
  for (int j = 0; j < robot.num_joints(); ++j) {
    Vector3d way = X_WL[j].translation();
    if (robot.parent(j) >= 0) way -= X_WL[robot.parent(j)].translation();
    longest = std::max(longest, way.norm());
  }
  return longest;
}

std::string ThreeDigits(double x) { return Format("%.3g", x); }

std::string NamesWhere(const Robot& robot,
                       const std::function<bool(const Link&)>& holds) {
  std::string names;
  for (const Link& link : robot.links) {
    if (holds(link)) names += (names.empty() ? "" : ", ") + link.name;
  }
  return names;
}

bool HasMass(const Link& link) {
  return link.has_inertial && link.inertial.mass > 0;
}

class RobotAudit {
 public:
  RobotAudit(const Robot& robot, const std::vector<std::string>& wide_angles)
      : robot_(robot), wide_angles_(wide_angles) {}

  std::vector<InspectionFinding> Run() {
    AddMissing();
    for (const Link& link : robot_.links) AddUnphysical(link);
    AddDefaults();
    AddAngles();
    AddMassUnit();
    if (!AddLengthUnit()) {
      for (const Link& link : robot_.links) AddSize(link);
    }
    AddLimits();
    return findings_;
  }

 private:
  void Add(const char* finding, const std::string& sentence,
           const std::string& evidence, const std::string& remedy) {
    findings_.push_back({finding, sentence, evidence, remedy});
  }

  void AddMissing() {
    const std::string names = NamesWhere(robot_, [](const Link& link) {
      return !link.has_inertial && !IsDeclaredMassless(link);
    });
    if (names.empty()) return;
    Add("no_inertia", "links have no inertia", names,
        "armcal calibrate needs none; for simulators export its robot.urdf");
  }

  void AddUnphysical(const Link& link) {
    if (!link.has_inertial) return;
    const std::string why = WhyUnphysical(link.inertial);
    if (why.empty()) return;
    Add("unphysical", "no body can have the inertia of " + link.name, why,
        "armcal calibrate exports one that can exist");
  }

  // Several links with one inertia, or all of their masses at their origins.
  void AddDefaults() {
    int same = 0, centred = 0, bodies = 0;
    const Link* first = nullptr;
    for (const Link& link : robot_.links) {
      if (!HasMass(link)) continue;
      ++bodies;
      centred += link.inertial.first_moment.norm() < 1e-9;
      if (first == nullptr) first = &link;
      same += CentralInertia(link.inertial)
                  .isApprox(CentralInertia(first->inertial), 1e-6);
    }
    if (bodies < 2) return;
    if (same == bodies) {
      Add("default_inertia", "all links have the same inertia: a placeholder",
          ThreeDigits(CentralInertia(first->inertial)(0, 0)) + " kg m^2",
          "trust it little in what follows: " + OptionName("trust") + "=1");
    }
    if (centred == bodies) {
      Add("default_inertia",
          "all links have their mass at their frame's origin",
          std::to_string(bodies) + " links",
          "trust it little in what follows: " + OptionName("trust") + "=1");
    }
  }

  void AddAngles() {
    constexpr size_t kMost = 3;  // that are named
    const std::vector<std::string>& wide = wide_angles_;
    if (wide.empty()) return;
    std::string evidence;
    for (size_t k = 0; k < std::min(kMost, wide.size()); ++k) {
      evidence += (k > 0 ? ", " : "") + wide[k];
    }
    if (wide.size() > kMost) {
      evidence += Format(" and %zu more", wide.size() - kMost);
    }
    Add("angle_unit", "the file turns by more than a whole turn: in degrees?",
        evidence, "a URDF's rpy are in rad");
  }

  double TotalMass() const {
    double mass = 0;
    for (const Link& link : robot_.links) mass += link.inertial.mass;
    return mass;
  }

  // Of one link a fit, or a drawing's placeholder, may be so dense; a unit is
  // that of all.
  void AddMassUnit() {
    int bodies = 0, too_dense = 0;
    for (const Link& link : robot_.links) {
      if (!HasMass(link) || !WhyUnphysical(link.inertial).empty()) continue;
      ++bodies;
      too_dense += IsTooDense(link.inertial);
    }
    if (2 * too_dense <= bodies) return;
    Add("mass_unit", "most links are denser than any solid: masses in g?",
        ThreeDigits(TotalMass()) + " kg in all, longest link " +
            ThreeDigits(LongestLink(robot_)) + " m",
        "a robot file's masses are in kg and its inertias in kg m^2");
  }

  // An arm that weighs less than a thousandth of the air in a cube on its
  // longest link. Files of ../shared/data and data/ have 2.4 to 830 kg/m^3 by
  // that cube, and so 2.4e-9 to 8.3e-7 with lengths in mm.
  bool AddLengthUnit() {
    constexpr double kLightest = 1e-3;  // kg/m^3
    const double length = LongestLink(robot_), mass = TotalMass();
    if (!(mass > 0) || !(mass < kLightest * length * length * length)) {
      return false;
    }
    Add("length_unit", "so light an arm is not that long: lengths in mm?",
        "longest link " + ThreeDigits(length) + " m, " + ThreeDigits(mass) +
            " kg in all",
        "a robot file's lengths are in m");
    return true;
  }

  // Meshes in mm make inertias a million times too large.
  void AddSize(const Link& link) {
    constexpr double kLarge = 3, kSmall = 1e-3;  // of the longest link
    if (!HasMass(link) || !WhyUnphysical(link.inertial).empty()) return;
    const double length = LongestLink(robot_);
    if (!(length > 0)) return;
    const double radius = RadiusOfGyration(link.inertial);
    const double com = link.inertial.first_moment.norm() / link.inertial.mass;
    if (radius > kLarge * length || (radius > 0 && radius < kSmall * length)) {
      Add("suspicious_inertia",
          "the inertia of " + link.name + " does not suit the arm's size",
          "radius of gyration " + ThreeDigits(radius) + " m, longest link " +
              ThreeDigits(length) + " m",
          "was it computed from a mesh in mm?");
    }
    if (com > kLarge * length) {
      Add("suspicious_inertia",
          "the centre of mass of " + link.name + " lies far outside the arm",
          ThreeDigits(com) + " m from the link's origin, longest link " +
              ThreeDigits(length) + " m",
          "is it in mm?");
    }
  }

  void AddLimits() {
    const std::string names = NamesWhere(robot_, [](const Link& link) {
      return link.joint.type != JointType::kContinuous &&
             !std::isfinite(link.joint.upper);
    });
    if (names.empty()) return;
    Add("no_limits", "joints have no position limits", names,
        "armcal excite " + OptionName("position_limits") + "=..");
  }

  const Robot& robot_;
  const std::vector<std::string>& wide_angles_;
  std::vector<InspectionFinding> findings_;
};

}  // namespace

std::vector<InspectionFinding> AuditRobot(
    const Robot& robot, const std::vector<std::string>& wide_angles) {
  return RobotAudit(robot, wide_angles).Run();
}

std::vector<std::string> RobotNotes(const Robot& robot) {
  constexpr double kUnlike = 3;
  if (robot.num_joints() < 3) return {};
  const Joint& first = robot.links[0].joint;
  double lightest = std::numeric_limits<double>::infinity(), heaviest = 0;
  for (const Link& link : robot.links) {
    const Joint& joint = link.joint;
    if (IsRotational(joint.type) != IsRotational(first.type) ||
        !std::isfinite(joint.velocity) || !std::isfinite(joint.effort) ||
        joint.velocity != first.velocity || joint.effort != first.effort) {
      return {};
    }
    if (!HasMass(link)) continue;
    lightest = std::min(lightest, link.inertial.mass);
    heaviest = std::max(heaviest, link.inertial.mass);
  }
  if (!(heaviest > kUnlike * lightest)) return {};
  return {
      Format("every joint has the same velocity and effort limit (%.4g "
             "%s/s, %.4g %s): they may be placeholders, which armcal "
             "excite would use",
             first.velocity, PositionUnit(first.type), first.effort,
             EffortUnit(first.type))};
}

}  // namespace armcal
