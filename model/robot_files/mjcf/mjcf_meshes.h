#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/robot/inertial_parameters.h"
#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_tree/model_folder.h"
#include "model/text/xml_element.h"

namespace armcal {

// The meshes of an MJCF file's <asset> sections. Their files are read when a
// body has no inertia of its own, and only then.
class MjcfMeshes {
 public:
  MjcfMeshes(const XmlElement& root, const MjcfDefaults& defaults,
             const ModelFolder& folder);

  // The body of density 1 kg/m^3 that a geom's mesh is, about the origin of its
  // frame. Throws InputError.
  InertialParameters Body(const MjcfElement& geom);
  // The names of the files that were read.
  const std::vector<std::string>& read() const { return read_; }

 private:
  InertialParameters Read(const MjcfElement& mesh);

  const ModelFolder& folder_;
  std::string directory_;  // that file names are relative to
  bool strip_path_ = false;
  std::map<std::string, MjcfElement> meshes_;
  std::map<std::string, InertialParameters> bodies_;  // of those that were read
  std::vector<std::string> read_;
  long bytes_ = 0;
};

}  // namespace armcal
