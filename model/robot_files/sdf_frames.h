#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>

#include "model/text/xml_element.h"

namespace armcal {

// Where the links, joints and frames of an SDF <model> stand (SDF 1.7 and
// later): each has a <pose> relative to another of them, by default the model's
// frame, of joints their child link, of frames what they are attached to.
class SdfFrames {
 public:
  // Throws InputError for names that are used twice.
  explicit SdfFrames(const XmlElement& model);

  // The pose in the model's frame M of a link, joint, frame or "__model__",
  // which `place` refers to. Throws InputError for unknown names and where
  // poses are relative to each other in a circle.
  Eigen::Isometry3d PoseOf(const std::string& name, const XmlElement& place);
  // The link that a frame or joint moves with; a link is its own.
  std::string LinkOf(const std::string& name, const XmlElement& place) const;
  // The same; empty where it moves with no link, as the model's own frames do.
  std::string OwnerOf(const std::string& name) const;

 private:
  struct Frame {
    XmlElement element;
    std::string reference;  // that its pose is relative to
    std::string attached;   // the link or frame that it moves with
  };
  const Frame& Find(const std::string& name, const XmlElement& place) const;
  // `depth`: how many poses it is asked for through.
  Eigen::Isometry3d PoseOf(const std::string& name, const XmlElement& place,
                           int depth);

  std::map<std::string, Frame> frames_;
  std::map<std::string, Eigen::Isometry3d> known_;
};

// The <pose> of an element, identity where it has none: x y z and roll pitch
// yaw (with degrees="true" in degrees), or with rotation_format="quat_xyzw" x y
// z and a quaternion. Throws InputError.
Eigen::Isometry3d ReadSdfPose(const XmlElement& owner);

}  // namespace armcal
