#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model/robot/robot.h"

namespace armcal {

// A rotation about, or a translation along, one axis of the frame it starts
// from: an elementary transform (Corke 2007). Its amount is `value`, plus the
// joint's position where `joint` is set.
struct ElementaryTransform {
  enum class Kind { kRotation, kTranslation, kConstant };
  Kind kind = Kind::kConstant;
  int axis = 2;      // 0: x, 1: y, 2: z
  double value = 0;  // rad or m
  int joint = -1;
  // Name of the geometric parameter that `value` is, such as "link2.a" or
  // "base.roll"; empty where it is not to be estimated.
  std::string name;
  int parameter = -1;  // index of that parameter
  Eigen::Isometry3d constant = Eigen::Isometry3d::Identity();

  // Goes on from *X by this one at `amount`, which is value + q.
  void Append(double amount, Eigen::Isometry3d* X) const;
};

// Where a geometric parameter acts at some joint position: d(pose)/d(value) of
// everything after it is a rotation about, or a translation along, `axis`
// through `origin`, both in W.
struct ParameterTwist {
  Eigen::Vector3d axis;
  Eigen::Vector3d origin;
  bool rotation;

  // d(p)/d(value) of a point p (in W) that moves with the tool.
  Eigen::Vector3d At(const Eigen::Vector3d& p) const {
    return rotation ? axis.cross(p - origin) : axis;
  }
};

// Where a geometric parameter acts on the moving arm: `twist`, in the frame L
// of `link` (-1: the base), moves with that link. Where `with_body` it
// displaces that link's body and all that the link carries; else the joint
// `next`, which sits on it, and what this moves (-1: all joints on it).
struct CarriedTwist {
  int link;
  bool with_body;
  ParameterTwist twist;
  int next = -1;
};

// Which of an arm's own parameters, besides base and tool, a calibration
// refines: kOffsets, the joints' zeros.
enum class RefineGeometry { kNothing, kOffsets, kAll };

// The geometry of an arm as a sequence of elementary transforms from the world
// to the tool, with the parameters of the file's own convention:
//   DH standard  <link>.theta .d .a .alpha        (F = P)
//   DH modified  <link>.alpha .a .theta .d
//   URDF         <link>.x .y .z .yaw .pitch .roll of the joint's origin, and
//                <link>.theta, the joint's zero
// A <link>.beta, a rotation about y (Hayati 1983), is added to DH rows whose
// axes are within 0.1 rad of parallel. base.x y z yaw pitch roll lie before the
// first link, tool.x y z yaw pitch roll after the last.
class ArmGeometry {
 public:
  explicit ArmGeometry(const Robot& robot);

  int size() const { return static_cast<int>(parameters_.size()); }
  // Whether parameter k is the base's, the tool's: six each, first and last.
  static bool IsBase(int k) { return k < 6; }
  bool IsTool(int k) const { return k >= size() - 6; }
  int num_joints() const { return static_cast<int>(links_.size()); }
  // The parameter that is added to the position of a joint that turns, its
  // <link>.theta, which each convention has behind the joint; -1 of one that
  // slides.
  int ZeroOf(int joint) const {
    const ElementaryTransform* const step = &steps_[links_[joint].joint];
    return step->kind == ElementaryTransform::Kind::kRotation
               ? (step + 1)->parameter
               : -1;
  }
  std::vector<std::string> Names() const;
  std::vector<std::string> Units() const;  // "m" or "rad"
  Eigen::VectorXd Values() const;
  void SetValues(const Eigen::VectorXd& values);

  // X_WT at joint positions q (n) for parameters `values` (size()), of a chain;
  // twists of all parameters, and of all joints by their positions, if not
  // null.
  Eigen::Isometry3d ToolPose(
      const Eigen::VectorXd& q, const double* values,
      std::vector<ParameterTwist>* twists,
      std::vector<ParameterTwist>* joints = nullptr) const;
  // Of all parameters, at their values.
  std::vector<CarriedTwist> CarriedTwists() const;
  // `robot` with this geometry: links, and the tool. The base pose is not part
  // of a robot file; gravity is turned by it instead.
  Robot ApplyTo(const Robot& robot) const;

 private:
  void Add(ElementaryTransform::Kind kind, int axis, double value,
           const std::string& name);
  void AddJoint(const Joint& joint, int index);
  void AddConstant(const Eigen::Isometry3d& X);
  void AddPose(const std::string& owner, const Eigen::Isometry3d& X);
  void AddStandardRow(const Link& link, int index, bool hayati);
  void AddModifiedRow(const Link& link, int index, bool hayati);
  void AddUrdfLink(const Link& link, int index);

  void AddCarriedTwists(int begin, int end, int link, int next,
                        std::vector<CarriedTwist>* twists) const;

  std::vector<ElementaryTransform> steps_;
  std::vector<int> parameters_;  // steps that are parameters
  // Per link: steps of X_PF [begin, joint), of X_ML (joint, end).
  struct LinkSteps {
    int begin, joint, end;
  };
  std::vector<LinkSteps> links_;
  LinkParents parents_;
  int base_end_ = 0;
};

}  // namespace armcal
