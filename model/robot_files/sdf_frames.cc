#include "model/robot_files/sdf_frames.h"

#include <utility>

#include "model/robot/axis_rotation.h"
#include "model/robot/robot.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

const char kModel[] = "__model__";

std::string ContentOf(const XmlElement& element, const char* tag) {
  const auto child = element.Child(tag);
  return child ? child->Content() : "";
}

std::string ReferenceOf(const XmlElement& element, const std::string& absent) {
  const auto pose = element.Child("pose");
  if (pose && pose->Has("relative_to")) {
    const std::string name = pose->Text("relative_to");
    if (!name.empty()) return name;
  }
  return absent;
}

}  // namespace

Isometry3d ReadSdfPose(const XmlElement& owner) {
  Isometry3d X = Isometry3d::Identity();
  const auto pose = owner.Child("pose");
  const std::string text = pose ? pose->Content() : "";
  if (text.empty()) return X;
  const bool quaternion = pose->Has("rotation_format") &&
                          pose->Text("rotation_format") == "quat_xyzw";
  const auto words = SplitWords(text);
  const size_t count = quaternion ? 7 : 6;
  double v[7];
  bool good = words.size() == count;
  for (size_t i = 0; good && i < count; ++i) {
    good = WhyNotNumbers(words[i], 1, "", &v[i]).empty();
  }
  if (!good) {
    pose->Refuse("", text,
                 quaternion ? "expected x y z and a quaternion x y z w"
                            : "expected x y z in m and roll pitch yaw");
  }
  X.translation() = Vector3d(v[0], v[1], v[2]);
  if (quaternion) {
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (q.norm() < 1e-6) {
      pose->Refuse("", text, "expected a quaternion that is not zero");
    }
    X.linear() = q.normalized().toRotationMatrix();
    return X;
  }
  const bool degrees = pose->Has("degrees") && pose->Text("degrees") == "true";
  X.linear() =
      RotationFromRpy(Vector3d(v[3], v[4], v[5]) * (degrees ? kDegree : 1));
  return X;
}

SdfFrames::SdfFrames(const XmlElement& model) {
  for (const char* tag : {"link", "joint", "frame"}) {
    for (const XmlElement& element : model.Children(tag)) {
      std::string attached, reference = kModel;
      if (element.tag() == "joint") {
        reference = attached = ContentOf(element, "child");
      } else if (element.tag() == "frame") {
        attached =
            element.Has("attached_to") ? element.Text("attached_to") : "";
        if (!attached.empty()) reference = attached;
      }
      const std::string name = element.Name("name");
      const auto [at, is_new] = frames_.emplace(
          name, Frame{element, ReferenceOf(element, reference), attached});
      if (!is_new) {
        element.RefuseUsedName(name, at->second.element.line());
      }
    }
  }
}

const SdfFrames::Frame& SdfFrames::Find(const std::string& name,
                                        const XmlElement& place) const {
  const auto found = frames_.find(name);
  if (found != frames_.end()) return found->second;
  place.Refuse("", name, "expected a link, joint or frame of the model");
}

Isometry3d SdfFrames::PoseOf(const std::string& name, const XmlElement& place) {
  return PoseOf(name, place, 0);
}

Isometry3d SdfFrames::PoseOf(const std::string& name, const XmlElement& place,
                             int depth) {
  if (name == kModel) return Isometry3d::Identity();
  const auto known = known_.find(name);
  if (known != known_.end()) return known->second;
  const Frame& frame = Find(name, place);
  if (depth >= static_cast<int>(frames_.size())) {
    place.Refuse("", name,
                 "expected poses that are not relative to each other in a "
                 "circle");
  }
  const Isometry3d X = PoseOf(frame.reference, frame.element, depth + 1) *
                       ReadSdfPose(frame.element);
  known_.emplace(name, X);
  return X;
}

std::string SdfFrames::OwnerOf(const std::string& name) const {
  std::string at = name;
  for (size_t steps = 0; steps <= frames_.size(); ++steps) {
    const auto found = frames_.find(at);
    if (found == frames_.end()) return "";
    if (found->second.element.tag() == "link") return at;
    at = found->second.attached;
  }
  return "";
}

std::string SdfFrames::LinkOf(const std::string& name,
                              const XmlElement& place) const {
  std::string at = name;
  for (size_t steps = 0; steps <= frames_.size(); ++steps) {
    const Frame& frame = Find(at, place);
    if (frame.element.tag() == "link") return at;
    at = frame.attached;
  }
  place.Refuse("", name, "expected what is attached to a link");
}

}  // namespace armcal
