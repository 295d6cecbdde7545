#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "model/text/document.h"
#include "model/text/xml_element.h"

namespace armcal {

// The folder that the files named by a robot's file must lie in: a robot file
// may come from anybody, and must not lead armcal to other files of its user.
class ModelFolder {
 public:
  // `allowed` is empty for the folder of the file itself; a text in memory has
  // none.
  ModelFolder(const Document& file, const std::string& allowed);

  // The file that `attribute` of `element` names: `named` below the folder of
  // the robot's file or, where there is none, below `beside`. It exists, lies
  // within the allowed folder, also by where links lead, and is no device.
  // Throws InputError.
  std::filesystem::path Find(const XmlElement& element, const char* attribute,
                             const std::filesystem::path& named,
                             const std::filesystem::path& beside) const;

  // Of the robot's file; empty for a text.
  const std::filesystem::path& folder() const { return folder_; }

 private:
  bool Holds(const std::filesystem::path& path) const;

  std::filesystem::path folder_, allowed_;
};

}  // namespace armcal
