#include "model/robot_files/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/robot/axis_rotation.h"
#include "model/robot_files/yaml_pose.h"
#include "model/robot_tree/robot_tree.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"
#include "model/text/yaml_node.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr size_t kMaxLinks = 64;

double NumberOr(const YamlNode& map, const std::string& key,
                const std::string& unit, double absent) {
  const std::optional<YamlNode> child = map.Child(key);
  return child ? child->Number(unit) : absent;
}

double NonNegativeOr0(const YamlNode& map, const std::string& key,
                      const std::string& unit) {
  const std::optional<YamlNode> child = map.Child(key);
  return child ? child->NonNegative(unit) : 0;
}

JointType ReadType(const YamlNode& node) {
  const std::string name = node.Choice({"revolute", "continuous", "prismatic"});
  for (const JointType type : {JointType::kRevolute, JointType::kContinuous}) {
    if (name == JointTypeName(type)) return type;
  }
  return JointType::kPrismatic;
}

double ReadPositiveLimit(const YamlNode& limits, const std::string& key,
                         const std::string& unit) {
  const std::optional<YamlNode> child = limits.Child(key);
  if (!child) return std::numeric_limits<double>::infinity();
  const double value = child->Number(unit);
  if (value <= 0) child->Refuse("expected a positive number in " + unit);
  return value;
}

void ReadLimits(const YamlNode& limits, Joint* joint) {
  const std::string unit = PositionUnit(joint->type);
  limits.ExpectKeys({"lower", "upper", "velocity", "effort"});
  for (const char* key : {"lower", "upper"}) {
    if (joint->type != JointType::kContinuous || !limits.Child(key)) continue;
    limits.Child(key)->Refuse(
        "expected no position limits of a continuous "
        "joint; is it revolute?");
  }
  joint->lower = NumberOr(limits, "lower", unit, joint->lower);
  joint->upper = NumberOr(limits, "upper", unit, joint->upper);
  if (joint->lower >= joint->upper) {
    limits.Child("lower")->Refuse("expected less than the upper limit " +
                                  NumberText(joint->upper));
  }
  joint->velocity = ReadPositiveLimit(limits, "velocity", unit + "/s");
  joint->effort = ReadPositiveLimit(limits, "effort", EffortUnit(joint->type));
}

void ReadJoint(const YamlNode& entry, const std::string& default_name,
               Joint* joint) {
  joint->type = ReadType(entry.RequiredChild("joint"));
  const std::optional<YamlNode> name = entry.Child("joint_name");
  joint->name = name ? name->Name() : default_name;
  const std::optional<YamlNode> limits = entry.Child("limits");
  if (limits) ReadLimits(*limits, joint);
  const std::string unit = EffortUnit(joint->type);
  const std::string position = PositionUnit(joint->type);
  joint->viscous = NonNegativeOr0(entry, "viscous", unit + " s/" + position);
  joint->coulomb = NonNegativeOr0(entry, "coulomb", unit);
  joint->armature = NonNegativeOr0(entry, "armature",
                                   IsRotational(joint->type) ? "kg m^2" : "kg");
  joint->offset = NumberOr(entry, "offset", unit, 0);
}

Matrix3d ReadInertia(const YamlNode& node) {
  const Eigen::VectorXd v = node.Vector("kg m^2");
  Matrix3d I = Matrix3d::Zero();
  if (v.size() == 3) {
    I.diagonal() = v;
  } else if (v.size() == 6) {
    I << v[0], v[1], v[3], v[1], v[2], v[4], v[3], v[4], v[5];
  } else {
    node.Refuse(
        "expected a list of Ixx, Ixy, Iyy, Ixz, Iyz, Izz or Ixx, Iyy, Izz");
  }
  if ((I.diagonal().array() < 0).any()) {
    node.Refuse("expected Ixx, Iyy and Izz that are not negative");
  }
  return I;
}

// From the centre of mass, or about the link's origin as armcal has it.
std::optional<InertialParameters> ReadBody(const YamlNode& entry) {
  const std::optional<YamlNode> com = entry.Child("com");
  const std::optional<YamlNode> inertia = entry.Child("inertia");
  const std::optional<YamlNode> mass = entry.Child("mass");
  const std::optional<YamlNode> all = entry.Child("inertial");
  if (all) {
    if (mass || com || inertia) {
      all->Refuse("expected either inertial or mass, com and inertia");
    }
    const Eigen::VectorXd v = all->Vector("kg, kg m, kg m^2");
    if (v.size() != 10 || v[0] < 0) {
      all->Refuse(
          "expected m, hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz, a mass that "
          "is not negative");
    }
    return InertialParameters::FromVector(v);
  }
  if (!mass && (com || inertia)) {
    (com ? com : inertia)->Refuse("expected the link's mass as well");
  }
  if (!mass) return std::nullopt;
  const Vector3d c = com ? com->Vector3("m") : Vector3d::Zero();
  const Matrix3d I = inertia ? ReadInertia(*inertia) : Matrix3d::Zero();
  return InertialParameters::FromCenterOfMass(mass->NonNegative("kg"), c, I);
}

void ReadInertial(const YamlNode& entry, Robot* robot, Link* link) {
  const std::optional<InertialParameters> body = ReadBody(entry);
  if (!body) return;
  const std::string name = Quoted(link->name);
  if (body->mass == 0) {
    robot->notes.push_back("link " + name +
                           " has mass 0, read as no inertia given");
    return;
  }
  link->has_inertial = true;
  link->inertial = *body;
  const std::string why = WhyUnphysical(link->inertial);
  if (why.empty()) return;
  robot->notes.push_back("the inertia of link " + name +
                         " is no rigid body's (" + why +
                         "); it serves as a start value only");
}

// What the table declares zero must be zero in the values it gives. Without
// mass nothing else is there either.
void ReadZeroInertials(const YamlNode& entry, Link* link) {
  const std::optional<YamlNode> zero = entry.Child("zero");
  if (!zero) return;
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i) names.push_back(InertialName(i));
  link->zero_inertials = zero->Choices(names);
  if (IsDeclaredMassless(*link)) {
    if (link->inertial.mass > 0) {
      zero->Refuse("expected a mass of 0, but the link has " +
                   NumberText(link->inertial.mass) + " kg");
    }
    return DeclareMassless(link);
  }
  const Vector10d values = link->inertial.ToVector();
  for (int i = 1; i < 10; ++i) {
    const double scale = i < 4 ? values.segment<3>(1).cwiseAbs().maxCoeff()
                               : values.tail<6>().cwiseAbs().maxCoeff();
    const auto& declared = link->zero_inertials;
    if (std::find(declared.begin(), declared.end(), InertialName(i)) ==
            declared.end() ||
        std::abs(values[i]) <= 1e-9 * scale) {
      continue;
    }
    zero->Refuse(std::string("expected ") + InertialName(i) +
                 " to be zero, but mass, com and inertia make it " +
                 NumberText(values[i]) + " " + InertialUnit(i));
  }
}

void ReadDhRow(const YamlNode& entry, DhConvention convention, Link* link) {
  DhParameters dh;
  dh.a = NumberOr(entry, "a", "m", 0);
  dh.d = NumberOr(entry, "d", "m", 0);
  dh.alpha = NumberOr(entry, "alpha", "rad", 0);
  dh.theta = NumberOr(entry, "theta", "rad", 0);
  SetDhPose(dh, convention, link);
  const std::optional<YamlNode> unknown = entry.Child("unknown");
  if (unknown) link->unknown_lengths = unknown->Choices({"a", "d"});
}

void ReadPoses(const YamlNode& entry, Link* link) {
  const auto pose = entry.Child("pose"), axis = entry.Child("axis"),
             link_pose = entry.Child("link_pose");
  if (pose) link->X_PF = ReadYamlPose(*pose);
  if (link_pose) link->X_ML = ReadYamlPose(*link_pose);
  if (!axis) return;
  const Vector3d xyz = axis->Vector3("1");
  if (xyz.stableNorm() < kShortestAxis) {
    axis->Refuse("expected an axis that is not zero");
  }
  const Matrix3d R = RotationOntoAxis(xyz.stableNormalized());
  link->X_PF = link->X_PF * Eigen::Isometry3d(R);
  link->X_ML = Eigen::Isometry3d(R.transpose()) * link->X_ML;
}

Link ReadLink(const YamlNode& entry,
              const std::optional<DhConvention>& convention,
              const std::string& number, Robot* robot) {
  std::vector<std::string> keys = {
      "name",    "joint",  "joint_name", "mass",    "com",
      "inertia", "limits", "viscous",    "coulomb", "armature",
      "offset",  "zero",   "inertial",   "parent"};
  const std::vector<std::string> of_row =
      convention
          ? std::vector<std::string>{"a", "d", "alpha", "theta", "unknown"}
          : std::vector<std::string>{"pose", "axis", "link_pose"};
  keys.insert(keys.begin() + 3, of_row.begin(), of_row.end());
  entry.ExpectKeys(keys);
  Link link;
  const std::optional<YamlNode> name = entry.Child("name");
  link.name = name ? name->Name() : "link" + number;
  ReadJoint(entry, "joint" + number, &link.joint);
  if (convention) {
    ReadDhRow(entry, *convention, &link);
  } else {
    ReadPoses(entry, &link);
  }
  ReadInertial(entry, robot, &link);
  ReadZeroInertials(entry, &link);
  return link;
}

// The link that the next one sits on: the one before or what this sits on, so
// that links are listed branch by branch.
int ReadParent(const YamlNode& entry, const Robot& robot) {
  const std::optional<YamlNode> node = entry.Child("parent");
  int parent = robot.num_joints() - 1;
  if (!node) return parent;
  const std::string name = node->Name();
  std::vector<std::string> names;
  for (; parent >= 0; parent = robot.parent(parent)) {
    if (robot.links[parent].name == name) return parent;
    names.push_back(robot.links[parent].name);
  }
  names.push_back("base");
  if (name == "base") return -1;
  node->Refuse(
      "expected the link before or one that carries it, as links are "
      "listed branch by branch: " +
      JoinNames(names));
}

// Leaves a chain's list of parents empty.
void AddParent(int parent, Robot* robot) {
  const int n = robot->num_joints();
  if (parent == n - 1 && robot->parents.empty()) return;
  while (static_cast<int>(robot->parents.size()) < n) {
    robot->parents.push_back(static_cast<int>(robot->parents.size()) - 1);
  }
  robot->parents.push_back(parent);
}

void ReadLinks(const YamlNode& links, Robot* robot) {
  const std::vector<YamlNode> entries = links.Entries();
  if (entries.empty()) links.Refuse("expected at least one link");
  if (entries.size() > kMaxLinks) {
    links.Refuse("expected at most " + std::to_string(kMaxLinks) + " links");
  }
  std::set<std::string> link_names, joint_names;
  for (size_t i = 0; i < entries.size(); ++i) {
    const Link link = ReadLink(entries[i], robot->dh_convention,
                               std::to_string(i + 1), robot);
    if (!link_names.insert(link.name).second) {
      entries[i].Refuse("the link name " + Quoted(link.name) +
                        " is used before");
    }
    if (!joint_names.insert(link.joint.name).second) {
      entries[i].Refuse("the joint name " + Quoted(link.joint.name) +
                        " is used before");
    }
    AddParent(ReadParent(entries[i], *robot), robot);
    robot->links.push_back(link);
  }
}

void ReadTool(const YamlNode& tool, Robot* robot) {
  const auto name = tool.Child("name"), pose = tool.Child("pose");
  if (pose) {
    tool.ExpectKeys({"name", "pose"});
  } else {
    tool.ExpectKeys({"name", "x", "y", "z", "roll", "pitch", "yaw"});
  }
  const auto get = [&](const char* key, const char* unit) {
    return NumberOr(tool, key, unit, 0);
  };
  robot->tool_name = name ? name->Name() : "tool";
  if (pose) {
    robot->X_LT = ReadYamlPose(*pose);
    return;
  }
  // Not by Eigen's <<, which must not be left by an exception.
  robot->X_LT.translation() =
      Vector3d(get("x", "m"), get("y", "m"), get("z", "m"));
  robot->X_LT.linear() = RotationFromRpy(
      {get("roll", "rad"), get("pitch", "rad"), get("yaw", "rad")});
}

}  // namespace

Robot ReadYaml(const Document& file, const RobotReaderOptions& options) {
  for (const auto& [option, value] : {std::make_pair("base", options.base),
                                      std::make_pair("tip", options.tip)}) {
    if (value.empty()) continue;
    throw InputError(file.name(), OptionName(option), OneLine(value),
                     "expected no such flag with a YAML robot, all of which "
                     "is used");
  }
  if (!options.posture.empty()) {
    throw InputError(
        file.name(), OptionName("posture"),
        OneLine(options.posture.begin()->first),
        "expected no such flag with a YAML robot, whose joints are "
        "all its own");
  }
  const YamlNode root = YamlNode::ReadFile(file);
  root.ExpectKeys({"name", "gravity", "convention", "links", "tool"});
  Robot robot;
  const std::optional<YamlNode> name = root.Child("name");
  robot.name = name ? name->Name() : "robot";
  const std::optional<YamlNode> gravity = root.Child("gravity");
  if (gravity) robot.gravity = gravity->Vector3("m/s^2");
  if (options.gravity) robot.gravity = *options.gravity;
  const std::string convention = root.RequiredChild("convention")
                                     .Choice({"standard", "modified", "poses"});
  if (convention == "standard") robot.dh_convention = DhConvention::kStandard;
  if (convention == "modified") robot.dh_convention = DhConvention::kModified;
  ReadLinks(root.RequiredChild("links"), &robot);
  const std::optional<YamlNode> tool = root.Child("tool");
  if (tool) ReadTool(*tool, &robot);
  return robot;
}

}  // namespace armcal
