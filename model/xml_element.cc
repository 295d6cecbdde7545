#include "model/xml_element.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "model/input_error.h"
#include "model/input_text.h"

namespace armcal {
namespace {

constexpr long kMaxBytes = 32L << 20;

std::string LinePlace(int line, const std::string& what) {
  return "line " + std::to_string(line) + (what.empty() ? "" : ", ") + what;
}

// The first declaration (<!DOCTYPE, <!ENTITY) outside comments and CDATA.
size_t FindDeclaration(std::string_view text) {
  size_t at = 0;
  while ((at = text.find("<!", at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    if (rest.substr(0, 4) == "<!--") {
      at = text.find("-->", at + 4);
    } else if (rest.substr(0, 9) == "<![CDATA[") {
      at = text.find("]]>", at);
    } else {
      return at;
    }
    if (at == std::string_view::npos) break;  // tinyxml2 will complain
  }
  return std::string_view::npos;
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
      return "expected XML";
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
                     "", "expected a plain URDF: run xacro first");
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

XmlElement::XmlElement(const std::string* file,
                       const tinyxml2::XMLElement* element)
    : file_(file), element_(element) {}

void XmlElement::SetOwner(const std::string& owner) {
  owner_ = owner;
  is_owner_ = true;
}

std::string XmlElement::tag() const { return element_->Name(); }
int XmlElement::line() const { return element_->GetLineNum(); }

std::vector<XmlElement> XmlElement::Children(const char* tag) const {
  std::vector<XmlElement> children;
  for (auto* child = element_->FirstChildElement(tag); child != nullptr;
       child = child->NextSiblingElement(tag)) {
    children.emplace_back(file_, child);
    children.back().owner_ = owner_;
  }
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
    Refuse("", "", std::string("expected a <") + tag + "> element");
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
    Refuse(attribute, text, "expected a plain URDF: run xacro first");
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
  throw InputError(*file_, LinePlace(line, what), OneLine(found), expected);
}

XmlFile::XmlFile(const std::string& path)
    : path_(path), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string text = ReadTextFile(path, kMaxBytes);
  RefuseDeclarations(path, text);
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(path, LinePlace(document_->ErrorLineNum(), ""), "",
                     WhyNotParsed(*document_));
  }
  const tinyxml2::XMLElement* root = document_->RootElement();
  if (root == nullptr) throw InputError(path, "", "", "expected XML elements");
  if (const auto* second = root->NextSiblingElement()) {
    throw InputError(path, LinePlace(second->GetLineNum(), ""),
                     "<" + OneLine(second->Name()) + ">",
                     "expected only one root element");
  }
  RefuseXacroElements(path, root);
}

XmlFile::~XmlFile() = default;

XmlElement XmlFile::root() const {
  return XmlElement(&path_, document_->RootElement());
}

}  // namespace armcal
