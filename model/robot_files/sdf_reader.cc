#include "model/robot_files/sdf_reader.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "model/robot_files/sdf_frames.h"
#include "model/robot_files/sdf_inertial.h"
#include "model/robot_files/sdf_values.h"
#include "model/robot_tree/robot_tree.h"
#include "model/robot_tree/tree_robot.h"
#include "model/text/input_text.h"
#include "model/text/xml_element.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// SDF writes what is not limited as 1e16 or inf, and as -1 for efforts and
// velocities.
constexpr double kUnlimited = 1e15;

// Infinite where the file has none, or a number that says so.
double LimitOr(const XmlElement& limit, const char* tag, double absent) {
  const auto child = limit.Child(tag);
  if (!child) return absent;
  const std::string text = child->Content();
  const auto value = ParseNumber(text);
  if (!value || std::isnan(*value))
    child->Refuse("", text, "expected a number");
  return std::abs(*value) < kUnlimited ? *value : absent;
}

class SdfModelReader {
 public:
  explicit SdfModelReader(const XmlElement& model)
      : model_(model), frames_(model) {}

  RobotTree Read(const Vector3d& gravity);

 private:
  void ReadLink(XmlElement element);
  void ReadJoint(XmlElement element);
  void ReadFrame(XmlElement element);
  void ReadType(const XmlElement& element, TreeJoint* joint);
  void ReadMotion(const XmlElement& element, const std::string& parent,
                  const std::string& child, TreeJoint* joint);
  void ReadAxis(const XmlElement& axis, const Matrix3d& R_MJ, TreeJoint* joint);
  void ReadLimit(const XmlElement& axis, Joint* joint);
  void ReadDynamics(const XmlElement& axis, TreeJoint* joint);
  void AddJoint(const XmlElement& element, TreeJoint joint);
  void AddCouplings();
  // The link that a joint's <parent> or <child> names.
  std::string End(const XmlElement& joint, const char* tag) const;
  int Number(const std::string& link) const { return links_.at(link); }

  XmlElement model_;
  SdfFrames frames_;
  RobotTree tree_;
  LinkIndex links_, joints_;
  // Joints whose child another moves already: {what, links}.
  struct Loop {
    std::string what;
    int parent, child;
  };
  std::vector<Loop> loops_;
};

void SdfModelReader::ReadLink(XmlElement element) {
  TreeLink link;
  link.name = element.Name("name");
  link.line = element.line();
  element.SetOwner("link " + Quoted(link.name));
  try {
    ReadSdfInertial(element, &link);
  } catch (const InputError& error) {
    link.error = error;
  }
  links_.emplace(link.name, static_cast<int>(tree_.links.size()));
  tree_.links.push_back(std::move(link));
}

void SdfModelReader::ReadType(const XmlElement& element, TreeJoint* joint) {
  joint->type = element.Name("type");
  joint->is_fixed = joint->type == "fixed";
  for (const JointType type :
       {JointType::kRevolute, JointType::kContinuous, JointType::kPrismatic}) {
    if (joint->type != JointTypeName(type)) continue;
    joint->joint.type = type;
    joint->is_supported = true;
  }
}

// The axis is in the joint's frame, or in that which `expressed_in` names.
void SdfModelReader::ReadAxis(const XmlElement& axis, const Matrix3d& R_MJ,
                              TreeJoint* joint) {
  const XmlElement xyz = axis.RequiredChild("xyz");
  Vector3d v = SdfVector(xyz, "");
  if (xyz.Has("expressed_in") && !xyz.Text("expressed_in").empty()) {
    v = R_MJ.transpose() *
        (frames_.PoseOf(xyz.Text("expressed_in"), xyz).linear() * v);
  } else if (SdfNumberOr(axis, "use_parent_model_frame", "", 0) != 0) {
    v = R_MJ.transpose() * v;  // before SDF 1.7
  }
  if (v.stableNorm() < kShortestAxis) {
    xyz.Refuse("", xyz.Content(), "expected an axis that is not zero");
  }
  SetAxis(v, joint);
}

void SdfModelReader::ReadLimit(const XmlElement& axis, Joint* joint) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto limit = axis.Child("limit");
  if (!limit) return;
  const double effort = LimitOr(*limit, "effort", kNone);
  const double velocity = LimitOr(*limit, "velocity", kNone);
  if (effort > 0) joint->effort = effort;
  if (velocity > 0) joint->velocity = velocity;
  if (joint->type == JointType::kContinuous) return;
  const double lower = LimitOr(*limit, "lower", -kNone);
  const double upper = LimitOr(*limit, "upper", kNone);
  if (lower > upper) {
    limit->Refuse("", NumberText(lower),
                  "expected a lower limit below the upper one");
  }
  if (lower == upper) return;
  joint->lower = lower;
  joint->upper = upper;
}

void SdfModelReader::ReadDynamics(const XmlElement& axis, TreeJoint* joint) {
  const auto dynamics = axis.Child("dynamics");
  if (!dynamics) return;
  const std::string unit = EffortUnit(joint->joint.type);
  joint->joint.viscous = SdfNonNegativeOr(
      *dynamics, "damping", unit + " s/" + PositionUnit(joint->joint.type), 0);
  joint->joint.coulomb = SdfNonNegativeOr(*dynamics, "friction", unit, 0);
  if (SdfNumberOr(*dynamics, "spring_stiffness", "", 0) == 0) return;
  joint->notes.push_back("the spring of joint " + Quoted(joint->joint.name) +
                         " is not used: armcal's joints have none");
}

void SdfModelReader::ReadMotion(const XmlElement& element,
                                const std::string& parent,
                                const std::string& child, TreeJoint* joint) {
  const Isometry3d X_MP = parent == "world" ? ReadSdfPose(model_).inverse()
                                            : frames_.PoseOf(parent, element);
  const Isometry3d X_MJ = frames_.PoseOf(joint->joint.name, element);
  joint->X_PJ = X_MP.inverse() * X_MJ;
  joint->X_JL = X_MJ.inverse() * frames_.PoseOf(child, element);
  if (!joint->is_supported) return;
  const XmlElement axis = element.RequiredChild("axis");
  ReadAxis(axis, X_MJ.linear(), joint);
  ReadLimit(axis, &joint->joint);
  ReadDynamics(axis, joint);
  const double ratio = SdfNumberOr(element, "drake:gear_ratio", "", 1);
  joint->joint.armature =
      SdfNonNegativeOr(element, "drake:rotor_inertia", "kg m^2", 0) * ratio *
      ratio;
}

std::string SdfModelReader::End(const XmlElement& joint,
                                const char* tag) const {
  const XmlElement end = joint.RequiredChild(tag);
  const std::string name = end.Content();
  if (name == "world" && std::string(tag) == "parent") return name;
  return frames_.LinkOf(name, end);
}

void SdfModelReader::ReadJoint(XmlElement element) {
  TreeJoint joint;
  joint.joint.name = element.Name("name");
  joint.line = element.line();
  element.SetOwner("joint " + Quoted(joint.joint.name));
  ReadType(element, &joint);
  const std::string parent = End(element, "parent");
  const std::string child = End(element, "child");
  joint.parent = Number(parent);
  joint.child = Number(child);
  joints_.emplace(joint.joint.name, static_cast<int>(tree_.joints.size()));
  try {
    ReadMotion(element, parent, child, &joint);
  } catch (const InputError& error) {
    joint.error = error;
  }
  AddJoint(element, std::move(joint));
}

void SdfModelReader::AddJoint(const XmlElement& element, TreeJoint joint) {
  // A link that is moved already, or that moves the parent, closes a loop.
  bool loop = tree_.links[joint.child].parent_joint >= 0;
  for (int link = joint.parent; !loop;) {
    loop = link == joint.child;
    const int above = tree_.links[link].parent_joint;
    if (above < 0) break;
    link = tree_.joints[above].parent;
  }
  if (loop) {
    loops_.push_back({"line " + std::to_string(element.line()) + ", joint " +
                          Quoted(joint.joint.name) + ", which closes a loop",
                      joint.parent, joint.child});
    joints_.erase(joint.joint.name);
    return;
  }
  const int number = static_cast<int>(tree_.joints.size());
  tree_.links[joint.child].parent_joint = number;
  tree_.links[joint.parent].child_joints.push_back(number);
  tree_.joints.push_back(std::move(joint));
}

// A frame on a link is a link without inertia that is fixed there: a tip may be
// called by it, and it may be the tool (TreeLink::is_frame).
void SdfModelReader::ReadFrame(XmlElement element) {
  TreeLink frame;
  frame.name = element.Name("name");
  frame.line = element.line();
  frame.is_frame = true;
  element.SetOwner("frame " + Quoted(frame.name));
  const std::string link = frames_.OwnerOf(frame.name);
  if (link.empty()) return;
  TreeJoint joint;
  joint.joint.name = frame.name;
  joint.type = "fixed";
  joint.is_fixed = true;
  joint.line = element.line();
  joint.parent = Number(link);
  joint.child = static_cast<int>(tree_.links.size());
  try {
    joint.X_PJ = frames_.PoseOf(link, element).inverse() *
                 frames_.PoseOf(frame.name, element);
  } catch (const InputError& error) {
    joint.error = error;
  }
  tree_.links.push_back(std::move(frame));
  AddJoint(element, std::move(joint));
}

void SdfModelReader::AddCouplings() {
  for (const Loop& loop : loops_) {
    tree_.couplings.push_back(
        {loop.what, tree_.JointsBetween(loop.parent, loop.child)});
  }
  for (const XmlElement& element : model_.Children("joint")) {
    const auto axis = element.Child("axis");
    const auto mimic = axis ? axis->Child("mimic") : std::nullopt;
    const auto follower = joints_.find(element.Text("name"));
    if (!mimic || follower == joints_.end()) continue;
    TreeCoupling coupling{"line " + std::to_string(element.line()) +
                              ", <mimic> of joint " +
                              Quoted(element.Text("name")),
                          {follower->second}};
    const auto leader =
        joints_.find(mimic->Has("joint") ? mimic->Text("joint") : "");
    if (leader != joints_.end()) coupling.joints.push_back(leader->second);
    tree_.couplings.push_back(std::move(coupling));
  }
}

RobotTree SdfModelReader::Read(const Vector3d& gravity) {
  tree_.name = model_.Has("name") ? model_.Name("name") : "robot";
  tree_.gravity = gravity;
  TreeLink world;
  world.name = "world";
  world.line = model_.line();
  links_.emplace("world", 0);
  tree_.links.push_back(std::move(world));
  for (const XmlElement& link : model_.Children("link")) ReadLink(link);
  for (const XmlElement& joint : model_.Children("joint")) ReadJoint(joint);
  for (const XmlElement& frame : model_.Children("frame")) ReadFrame(frame);
  AddCouplings();
  if (tree_.links.size() == 1) {
    model_.Refuse("", "", "expected at least one <link>");
  }
  for (size_t i = 0; i < tree_.links.size(); ++i) {
    const bool is_root = tree_.links[i].parent_joint < 0 &&
                         (i > 0 || !tree_.links[0].child_joints.empty());
    if (is_root) tree_.roots.push_back(static_cast<int>(i));
  }
  // A model that nothing fixes stands as its file puts it.
  if (tree_.roots.size() == 1 && tree_.roots[0] > 0) {
    const Isometry3d X_WL =
        ReadSdfPose(model_) *
        frames_.PoseOf(tree_.links[tree_.roots[0]].name, model_);
    tree_.gravity = X_WL.linear().transpose() * gravity;
  }
  return std::move(tree_);
}

Vector3d GravityOf(const XmlElement& world) {
  const auto gravity = world.Child("gravity");
  return gravity ? SdfVector(*gravity, "m/s^2") : Vector3d(0, 0, -9.8);
}

void RefuseOthers(const XmlElement& holder) {
  for (const char* tag : {"include", "model"}) {
    for (const XmlElement& other : holder.Children(tag)) {
      other.Refuse("", other.Has("name") ? other.Text("name") : "",
                   "expected a model that is one, of this file alone: gz sdf "
                   "-p FILE writes out what it includes");
    }
  }
}

}  // namespace

Robot ReadSdf(const Document& document, const RobotReaderOptions& options) {
  const XmlFile file(document);
  const XmlElement root = file.root();
  if (root.tag() != "sdf") {
    root.Refuse("", root.tag(), "expected the root element <sdf>");
  }
  const auto world = root.Child("world");
  const XmlElement& holder = world ? *world : root;
  const XmlElement model = holder.RequiredChild("model");
  RefuseOthers(model);
  const Vector3d gravity = world ? GravityOf(*world) : Vector3d(0, 0, -9.81);
  return MakeTreeRobot(document.name(), SdfModelReader(model).Read(gravity),
                       options);
}

}  // namespace armcal
