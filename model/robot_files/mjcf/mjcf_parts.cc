#include "model/robot_files/mjcf/mjcf_parts.h"

#include "model/robot_files/mjcf/mjcf_pose.h"

namespace armcal {
namespace {

class PartReader {
 public:
  PartReader(const MjcfDefaults& defaults, const MjcfSettings& settings)
      : defaults_(defaults), settings_(settings) {}

  void Add(const XmlElement& holder, const Eigen::Isometry3d& X_BF,
           const std::string& childclass) {
    for (const XmlElement& child : holder.Children(nullptr)) {
      if (child.tag() != "frame") {
        parts.push_back({child, X_BF, childclass});
        continue;
      }
      Add(child, X_BF * ReadMjcfPose(MjcfElement({child}), settings_),
          defaults_.ChildClass(child, childclass));
    }
  }

  std::vector<MjcfPart> parts;

 private:
  const MjcfDefaults& defaults_;
  const MjcfSettings& settings_;
};

}  // namespace

std::vector<MjcfPart> ReadMjcfParts(const XmlElement& body,
                                    const std::string& childclass,
                                    const MjcfDefaults& defaults,
                                    const MjcfSettings& settings) {
  PartReader reader(defaults, settings);
  reader.Add(body, Eigen::Isometry3d::Identity(), childclass);
  return std::move(reader.parts);
}

}  // namespace armcal
