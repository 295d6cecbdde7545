#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/robot_tree/model_folder.h"
#include "model/text/document.h"
#include "model/text/xml_element.h"

namespace armcal {

// Reads an MJCF file and, in the place of its <include> elements, the files
// that they name, as MuJoCo does: relative to the robot's file or else to the
// including one, each file once. `folder` says which files may be named. Adds
// the names of the files to `notes`. Refuses more than 32 MiB, 200 files or 20
// files that include each other in a row. Throws InputError.
std::unique_ptr<XmlFile> ReadMjcfXml(const Document& document,
                                     const ModelFolder& folder,
                                     std::vector<std::string>* notes);

}  // namespace armcal
