#include "model/text/xml_element.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr long kMaxXmlBytes = 32L << 20;
// The parser compares each of an element's attributes with all others.
constexpr int kMostAttributes = 1000;

std::string LinePlace(int line, const std::string& what) {
  return "line " + std::to_string(line) + (what.empty() ? "" : ", ") + what;
}

// Where the comment, CDATA or instruction that begins at `at` ends; `at` itself
// where something else begins.
size_t EndOfOpaque(std::string_view text, size_t at) {
  constexpr std::string_view kKinds[][2] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  for (const auto& [begin, end] : kKinds) {
    if (text.substr(at, begin.size()) != begin) continue;
    return std::min(text.find(end, at + begin.size()), text.size());
  }
  return at;
}

// The first declaration (<!DOCTYPE, <!ENTITY) outside comments and CDATA.
size_t FindDeclaration(std::string_view text) {
  for (size_t at = text.find('<'); at != text.npos; at = text.find('<', at)) {
    const size_t end = EndOfOpaque(text, at);
    if (end == at && text.substr(at, 2) == "<!") return at;
    at = std::max(end, at + 1);
  }
  return text.npos;
}

void RefuseDeclarations(const std::string& path, const std::string& text) {
  const size_t at = FindDeclaration(text);
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
  const size_t end = text.find_first_of(" \t\r\n>[", at);
  throw InputError(path, LinePlace(static_cast<int>(line), ""),
                   OneLine(text.substr(at, std::min(end, text.size()) - at)),
                   "expected no DOCTYPE or entity declarations");
}

// How many attributes the tag at `at` has; moves `at` behind it.
int CountAttributes(std::string_view text, size_t* at) {
  int count = 0;
  char quote = 0;
  for (; *at < text.size(); ++*at) {
    const char c = text[*at];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      break;
    } else if (c == '=') {
      ++count;
    }
  }
  return count;
}

void RefuseManyAttributes(const std::string& path, std::string_view text) {
  for (size_t at = text.find('<'); at != text.npos; at = text.find('<', at)) {
    const size_t begin = at;
    at = EndOfOpaque(text, at);
    if (at != begin || CountAttributes(text, &at) <= kMostAttributes) continue;
    const auto line = 1 + std::count(text.begin(), text.begin() + begin, '\n');
    throw InputError(path, LinePlace(static_cast<int>(line), ""), "",
                     "expected an element of at most " +
                         std::to_string(kMostAttributes) + " attributes");
  }
}

std::string WhyNotParsed(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
    case tinyxml2::XML_ERROR_PARSING:
      return "an element is not closed or closed by another name; is the file "
             "truncated?";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is malformed or given twice";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "expected XML: elements, and no text around them";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment has no end (-->)";
    default:
      // "XML_ERROR_PARSING_ATTRIBUTE" -> "parsing attribute"
      std::string name = document.ErrorName();
      name.erase(0, std::string("XML_ERROR_").size());
      std::replace(name.begin(), name.end(), '_', ' ');
      for (char& c : name) c = static_cast<char>(std::tolower(c));
      return "not well-formed XML (" + name + "); is the file truncated?";
  }
}

void RefuseXacro(const std::string& path, const tinyxml2::XMLElement& element) {
  const std::string tag = element.Name();
  if (tag.rfind("xacro:", 0) == 0) {
    throw InputError(path,
                     LinePlace(element.GetLineNum(), "<" + OneLine(tag) + ">"),
                     "", kRunXacro);
  }
}

void RefuseXacroElements(const std::string& path,
                         const tinyxml2::XMLElement* root) {
  const tinyxml2::XMLElement* element = root;
  while (element != nullptr) {
    RefuseXacro(path, *element);
    const tinyxml2::XMLElement* next = element->FirstChildElement();
    while (next == nullptr && element != root) {
      next = element->NextSiblingElement();
      if (next == nullptr) element = element->Parent()->ToElement();
    }
    element = next;
  }
}

}  // namespace

XmlElement::XmlElement(const XmlFile* file, const tinyxml2::XMLElement* element)
    : file_(file), element_(element) {}

void XmlElement::SetOwner(const std::string& owner) {
  owner_ = owner;
  is_owner_ = true;
}

std::string XmlElement::tag() const { return element_->Name(); }
int XmlElement::line() const { return element_->GetLineNum(); }

std::vector<XmlElement> XmlElement::Children(const char* tag) const {
  std::vector<XmlElement> children;
  for (auto* child = element_->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const XmlFile* other = file_->IncludedAt(child)) {
      for (const XmlElement& inner : other->root().Children(tag)) {
        children.push_back(inner);
      }
    } else if (tag == nullptr || std::string_view(child->Name()) == tag) {
      children.emplace_back(file_, child);
    }
  }
  for (XmlElement& child : children) child.owner_ = owner_;
  return children;
}

std::optional<XmlElement> XmlElement::Child(const char* tag) const {
  const std::vector<XmlElement> children = Children(tag);
  if (children.empty()) return std::nullopt;
  if (children.size() > 1) {
    children[1].Refuse("", "",
                       std::string("expected only one <") + tag + "> element");
  }
  return children.front();
}

XmlElement XmlElement::RequiredChild(const char* tag) const {
  const std::optional<XmlElement> child = Child(tag);
  if (!child) {
    Refuse("", "", std::string("expected an element <") + tag + ">");
  }
  return *child;
}

bool XmlElement::Has(const char* attribute) const {
  return element_->Attribute(attribute) != nullptr;
}

std::string XmlElement::Text(const char* attribute) const {
  const char* value = element_->Attribute(attribute);
  if (value == nullptr) {
    Refuse("", "", std::string("expected an attribute '") + attribute + "'");
  }
  const std::string text = value;
  if (text.find("${") != std::string::npos ||
      text.find("$(") != std::string::npos) {
    Refuse(attribute, text, kRunXacro);
  }
  return text;
}

std::string XmlElement::Name(const char* attribute) const {
  const std::string name = Text(attribute);
  const bool control = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (control) {
    Refuse(attribute, name, "expected a name without control characters");
  }
  if (SplitWords(name).empty()) Refuse(attribute, name, "expected a name");
  return name;
}

std::string XmlElement::Content() const {
  const char* text = element_->GetText();
  return text == nullptr ? "" : std::string(Trim(text, " \t\r\n"));
}

double XmlElement::Number(const char* attribute,
                          const std::string& unit) const {
  double value = 0;
  Numbers(attribute, 1, unit, &value);
  return value;
}

double XmlElement::NonNegative(const char* attribute,
                               const std::string& unit) const {
  const double value = Number(attribute, unit);
  if (value < 0) {
    Refuse(attribute, Text(attribute),
           "expected a number in " + unit + " that is not negative");
  }
  return value;
}

Eigen::Vector3d XmlElement::Vector(const char* attribute,
                                   const std::string& unit) const {
  Eigen::Vector3d vector;
  Numbers(attribute, 3, unit, vector.data());
  return vector;
}

void XmlElement::Numbers(const char* attribute, int count,
                         const std::string& unit, double* values) const {
  const std::string text = Text(attribute);
  const std::string why = WhyNotNumbers(text, count, unit, values);
  if (!why.empty()) Refuse(attribute, text, why);
}

void XmlElement::RefuseUsedName(const std::string& name, int first) const {
  Refuse("name", name,
         "expected a name that is not yet used (line " + std::to_string(first) +
             ")");
}

void XmlElement::Refuse(const std::string& attribute, const std::string& found,
                        const std::string& expected) const {
  int line = element_->GetLineNum();
  std::string what = "<" + OneLine(tag());
  if (!attribute.empty()) {
    what += " " + attribute;
    const auto* a = element_->FindAttribute(attribute.c_str());
    if (a != nullptr) line = a->GetLineNum();
  }
  what += owner_.empty() ? ">" : "> of " + owner_;
  if (attribute.empty() && is_owner_) what = owner_;
  throw InputError(file_->path(), LinePlace(line, what), OneLine(found),
                   expected);
}

XmlFile::XmlFile(const Document& document)
    : path_(document.name()),
      document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text = document.Text(kMaxXmlBytes);
  RefuseDeclarations(path_, text);
  RefuseManyAttributes(path_, text);
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(path_, LinePlace(document_->ErrorLineNum(), ""), "",
                     WhyNotParsed(*document_));
  }
  const tinyxml2::XMLElement* root = document_->RootElement();
  if (root == nullptr) throw InputError(path_, "", "", "expected XML elements");
  if (const auto* second = root->NextSiblingElement()) {
    throw InputError(path_, LinePlace(second->GetLineNum(), ""),
                     "<" + OneLine(second->Name()) + ">",
                     "expected only one root element");
  }
  RefuseXacroElements(path_, root);
}

XmlFile::~XmlFile() = default;

void XmlFile::Include(const XmlElement& at, std::unique_ptr<XmlFile> other) {
  included_[at.element_] = std::move(other);
}

const XmlFile* XmlFile::IncludedAt(const tinyxml2::XMLElement* element) const {
  const auto found = included_.find(element);
  return found == included_.end() ? nullptr : found->second.get();
}

XmlElement XmlFile::root() const {
  return XmlElement(this, document_->RootElement());
}

}  // namespace armcal
