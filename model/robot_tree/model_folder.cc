#include "model/robot_tree/model_folder.h"

#include <algorithm>
#include <system_error>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

// Without links and "..", where it exists.
fs::path Canonical(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path), error);
  return error ? path : canonical;
}

}  // namespace

ModelFolder::ModelFolder(const Document& file, const std::string& allowed) {
  if (!file.is_file()) return;
  folder_ = Canonical(file.name()).parent_path();
  allowed_ = allowed.empty() ? folder_ : Canonical(allowed);
  std::error_code error;
  if (allowed.empty() || fs::is_directory(allowed_, error)) return;
  throw InputError("", OptionName("robot_folder"), OneLine(allowed),
                   "expected a folder");
}

bool ModelFolder::Holds(const fs::path& path) const {
  const auto [at, unused] =
      std::mismatch(allowed_.begin(), allowed_.end(), path.begin(), path.end());
  // A path that ends in a slash has an empty last part.
  return at == allowed_.end() ||
         (at->empty() && std::next(at) == allowed_.end());
}

fs::path ModelFolder::Find(const XmlElement& element, const char* attribute,
                           const fs::path& named,
                           const fs::path& beside) const {
  const std::string text = element.Text(attribute);
  if (folder_.empty()) {
    element.Refuse(attribute, text,
                   "expected a robot that is one text: only a file has a "
                   "folder with others");
  }
  std::error_code error;
  fs::path path = Canonical(folder_ / named);
  if (!fs::exists(path, error) && !beside.empty()) {
    const fs::path other = Canonical(beside / named);
    if (Holds(other)) path = other;
  }
  if (!Holds(path)) {
    element.Refuse(attribute, text,
                   "expected a file in the robot file's own folder; " +
                       OptionName("robot_folder") +
                       "=DIR allows those in another");
  }
  if (!fs::is_regular_file(path, error)) {
    element.Refuse(attribute, text, "expected a file that exists");
  }
  return path;
}

}  // namespace armcal
