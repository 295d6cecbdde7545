#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/text/document.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace armcal {

class XmlFile;

// What to do about a file with macros that were not expanded.
inline constexpr char kRunXacro[] =
    "expected a plain URDF: run xacro first (xacro robot.urdf.xacro > "
    "robot.urdf)";

// An element of an XmlFile, which must outlive it. Reading is strict: what is
// not as asked throws InputError with line, element, attribute and value.
class XmlElement {
 public:
  XmlElement(const XmlFile* file, const tinyxml2::XMLElement* element);

  // Says in messages whose element this and its children are: "link 'arm'".
  void SetOwner(const std::string& owner);
  const std::string& owner() const { return owner_; }
  std::string tag() const;
  int line() const;
  const XmlFile& file() const { return *file_; }
  // Whether they are the same element of the same file.
  bool Is(const XmlElement& other) const { return element_ == other.element_; }

  // Of that tag; null: all. In the place of an element where a file is included
  // stand that file's.
  std::vector<XmlElement> Children(const char* tag) const;
  // The child of that tag, if any; two are refused.
  std::optional<XmlElement> Child(const char* tag) const;
  XmlElement RequiredChild(const char* tag) const;

  bool Has(const char* attribute) const;
  std::string Text(const char* attribute) const;
  // A text that is not empty and has no control characters.
  std::string Name(const char* attribute) const;
  // The text between its tags, without blanks around it.
  std::string Content() const;
  // A finite number; `unit` ("kg") is for messages.
  double Number(const char* attribute, const std::string& unit) const;
  // The same, and not less than 0.
  double NonNegative(const char* attribute, const std::string& unit) const;
  // Three finite numbers.
  Eigen::Vector3d Vector(const char* attribute, const std::string& unit) const;

  // `count` finite numbers, 1 to 6.
  void Numbers(const char* attribute, int count, const std::string& unit,
               double* values) const;

  // Throws InputError for a name that the element on line `first` has already.
  [[noreturn]] void RefuseUsedName(const std::string& name, int first) const;
  // Throws InputError at this element, or at `attribute` where it is not empty.
  [[noreturn]] void Refuse(const std::string& attribute,
                           const std::string& found,
                           const std::string& expected) const;

 private:
  friend class XmlFile;
  const XmlFile* file_;
  const tinyxml2::XMLElement* element_;
  std::string owner_;
  bool is_owner_ = false;
};

// A parsed XML file, or text in memory. Refuses, besides what is not well
// formed: more than 32 MiB, UTF-16, any DOCTYPE, nesting deeper than tinyxml2
// allows (100), two roots, repeated attributes and xacro elements.
class XmlFile {
 public:
  explicit XmlFile(const Document& document);
  ~XmlFile();
  const std::string& path() const { return path_; }
  XmlElement root() const;

  // From now on the children of the root of `other` stand in the place of the
  // element `at` of this file.
  void Include(const XmlElement& at, std::unique_ptr<XmlFile> other);
  // The file that stands in the place of an element, if any.
  const XmlFile* IncludedAt(const tinyxml2::XMLElement* element) const;

 private:
  std::string path_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
  std::map<const tinyxml2::XMLElement*, std::unique_ptr<XmlFile>> included_;
};

}  // namespace armcal
