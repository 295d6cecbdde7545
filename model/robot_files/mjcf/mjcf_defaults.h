#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "model/text/xml_element.h"

namespace armcal {

// An MJCF element together with what the default classes say in its stead.
class MjcfElement {
 public:
  // The element itself, then the defaults, those that matter more first.
  explicit MjcfElement(std::vector<XmlElement> holders)
      : holders_(std::move(holders)) {}

  const XmlElement& own() const { return holders_.front(); }
  // Whichever says it first, and so is to blame for it; itself if none does.
  const XmlElement& HolderOf(const char* attribute) const;
  const std::vector<XmlElement>& holders() const { return holders_; }

  bool Has(const char* attribute) const;
  // "" where nobody says it.
  std::string Text(const char* attribute) const;
  double NumberOr(const char* attribute, const std::string& unit,
                  double absent) const;
  double NonNegativeOr0(const char* attribute, const std::string& unit) const;
  Eigen::Vector3d VectorOr(const char* attribute, const std::string& unit,
                           const Eigen::Vector3d& absent) const;
  // Two numbers, the first at most the second.
  Eigen::Vector2d Range(const char* attribute, const std::string& unit) const;
  // One of `allowed`, the first of them where nobody says it.
  std::string Choice(const char* attribute,
                     const std::vector<std::string>& allowed) const;

 private:
  std::vector<XmlElement> holders_;
};

// The default classes of a file. A class has what it says itself, then what the
// class that it stands in says, up to "main". An element is of the class that
// it names, else of the `childclass` of the body nearest around it, else of
// "main".
class MjcfDefaults {
 public:
  explicit MjcfDefaults(const XmlElement& root);

  MjcfElement Of(const XmlElement& element,
                 const std::string& childclass) const;
  // All shortcuts (motor, position, ...) are one kind: general.
  MjcfElement OfActuator(const XmlElement& element) const;
  // All kinds of equalities have their defaults in one: <equality>.
  MjcfElement OfEquality(const XmlElement& element) const;
  // And both kinds of tendons: <tendon>.
  MjcfElement OfTendon(const XmlElement& element) const;
  // The childclass within `body`, `around` where it names none.
  std::string ChildClass(const XmlElement& body,
                         const std::string& around) const;

 private:
  void AddClass(const XmlElement& element, std::vector<XmlElement> chain);
  const std::vector<XmlElement>& ClassOf(const XmlElement& element,
                                         const std::string& childclass) const;
  MjcfElement With(const XmlElement& element, const std::string& childclass,
                   const std::string& tag) const;

  // Per class its <default> element and those around it, inner ones first.
  std::map<std::string, std::vector<XmlElement>> classes_;
};

}  // namespace armcal
