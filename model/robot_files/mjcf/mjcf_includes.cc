#include "model/robot_files/mjcf/mjcf_includes.h"

#include <filesystem>
#include <set>
#include <system_error>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

constexpr int kMostIncludes = 200;
constexpr int kMostNested = 20;
constexpr long kMostIncludedBytes = 32L << 20;

class Includer {
 public:
  explicit Includer(const ModelFolder& folder) : folder_(folder) {}

  void Start(const Document& document) {
    std::error_code error;
    if (document.is_file()) seen_.insert(fs::canonical(document.name(), error));
  }
  // `beside` is the folder of `file`.
  void IncludeAll(const XmlElement& element, const fs::path& beside, int depth,
                  XmlFile* file);
  const std::vector<std::string>& names() const { return names_; }

 private:
  void Include(const XmlElement& at, const fs::path& beside, int depth,
               XmlFile* file);

  const ModelFolder& folder_;
  std::set<fs::path> seen_;
  std::vector<std::string> names_;
  long bytes_ = 0;
};

void Includer::Include(const XmlElement& at, const fs::path& beside, int depth,
                       XmlFile* file) {
  const std::string named = at.Name("file");
  const fs::path path = folder_.Find(at, "file", named, beside);
  if (!seen_.insert(path).second) {
    at.Refuse("file", named, "expected a file that is not included already");
  }
  std::error_code error;
  bytes_ += static_cast<long>(fs::file_size(path, error));
  if (depth > kMostNested || seen_.size() > kMostIncludes ||
      bytes_ > kMostIncludedBytes) {
    at.Refuse("file", named,
              "expected at most " + std::to_string(kMostIncludes) +
                  " files of together " +
                  std::to_string(kMostIncludedBytes >> 20) +
                  " MiB, and at most " + std::to_string(kMostNested) +
                  " that include each other in a row");
  }
  names_.push_back(named);
  auto other = std::make_unique<XmlFile>(Document(path.string()));
  XmlFile* const included = other.get();
  file->Include(at, std::move(other));
  IncludeAll(included->root(), path.parent_path(), depth + 1, included);
}

void Includer::IncludeAll(const XmlElement& element, const fs::path& beside,
                          int depth, XmlFile* file) {
  for (const XmlElement& child : element.Children(nullptr)) {
    if (child.tag() == "include") {
      Include(child, beside, depth, file);
    } else {
      IncludeAll(child, beside, depth, file);
    }
  }
}

}  // namespace

std::unique_ptr<XmlFile> ReadMjcfXml(const Document& document,
                                     const ModelFolder& folder,
                                     std::vector<std::string>* notes) {
  auto file = std::make_unique<XmlFile>(document);
  Includer includer(folder);
  includer.Start(document);
  includer.IncludeAll(file->root(), folder.folder(), 1, file.get());
  if (!includer.names().empty()) {
    notes->push_back("read as well, by <include>: " +
                     JoinNames(includer.names()));
  }
  return file;
}

}  // namespace armcal
