#include "model/robot_files/mjcf/mjcf_defaults.h"

#include <algorithm>
#include <array>

#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr std::array<const char*, 9> kActuators = {
    "general", "motor",    "position", "intvelocity", "velocity",
    "damper",  "cylinder", "muscle",   "adhesion"};

std::string Alternatives(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace

const XmlElement& MjcfElement::HolderOf(const char* attribute) const {
  for (const XmlElement& holder : holders_) {
    if (holder.Has(attribute)) return holder;
  }
  return own();
}

bool MjcfElement::Has(const char* attribute) const {
  return HolderOf(attribute).Has(attribute);
}

std::string MjcfElement::Text(const char* attribute) const {
  return Has(attribute) ? HolderOf(attribute).Text(attribute) : "";
}

double MjcfElement::NumberOr(const char* attribute, const std::string& unit,
                             double absent) const {
  return Has(attribute) ? HolderOf(attribute).Number(attribute, unit) : absent;
}

double MjcfElement::NonNegativeOr0(const char* attribute,
                                   const std::string& unit) const {
  return Has(attribute) ? HolderOf(attribute).NonNegative(attribute, unit) : 0;
}

Eigen::Vector3d MjcfElement::VectorOr(const char* attribute,
                                      const std::string& unit,
                                      const Eigen::Vector3d& absent) const {
  return Has(attribute) ? HolderOf(attribute).Vector(attribute, unit) : absent;
}

Eigen::Vector2d MjcfElement::Range(const char* attribute,
                                   const std::string& unit) const {
  const XmlElement& holder = HolderOf(attribute);
  Eigen::Vector2d range;
  holder.Numbers(attribute, 2, unit, range.data());
  if (range[0] > range[1]) {
    holder.Refuse(attribute, holder.Text(attribute),
                  "expected the smaller number first");
  }
  return range;
}

std::string MjcfElement::Choice(const char* attribute,
                                const std::vector<std::string>& allowed) const {
  if (!Has(attribute)) return allowed.front();
  const std::string text = Text(attribute);
  if (std::count(allowed.begin(), allowed.end(), text) == 0) {
    HolderOf(attribute).Refuse(attribute, text,
                               "expected " + Alternatives(allowed));
  }
  return text;
}

MjcfDefaults::MjcfDefaults(const XmlElement& root) {
  classes_["main"];
  for (const XmlElement& element : root.Children("default")) {
    if (element.Has("class") && element.Text("class") != "main") {
      element.Refuse("class", element.Text("class"),
                     "expected main, or no class, of a <default> that stands "
                     "in no other");
    }
    AddClass(element, classes_["main"]);
  }
}

void MjcfDefaults::AddClass(const XmlElement& element,
                            std::vector<XmlElement> chain) {
  const bool is_main = element.owner().empty() && !element.Has("class");
  const std::string name = is_main ? "main" : element.Name("class");
  XmlElement named = element;
  named.SetOwner("default class " + Quoted(name));
  chain.insert(chain.begin(), named);
  if (name != "main" && !classes_.emplace(name, chain).second) {
    element.Refuse("class", name, "expected a class that is not yet used");
  }
  if (name == "main") classes_[name] = chain;
  for (const XmlElement& inner : named.Children("default")) {
    AddClass(inner, chain);
  }
}

const std::vector<XmlElement>& MjcfDefaults::ClassOf(
    const XmlElement& element, const std::string& childclass) const {
  const char* attribute = element.Has("class") ? "class" : "childclass";
  const std::string name =
      element.Has("class") ? element.Name("class") : childclass;
  const auto found = classes_.find(name.empty() ? "main" : name);
  if (found != classes_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& known : classes_) names.push_back(known.first);
  element.Refuse(attribute, name,
                 "expected one of the default classes " + JoinNames(names));
}

MjcfElement MjcfDefaults::With(const XmlElement& element,
                               const std::string& childclass,
                               const std::string& tag) const {
  std::vector<XmlElement> holders = {element};
  for (const XmlElement& of_class : ClassOf(element, childclass)) {
    const auto same = of_class.Children(tag.c_str());
    holders.insert(holders.end(), same.rbegin(), same.rend());
  }
  return MjcfElement(std::move(holders));
}

MjcfElement MjcfDefaults::Of(const XmlElement& element,
                             const std::string& childclass) const {
  return With(element, childclass, element.tag());
}

MjcfElement MjcfDefaults::OfEquality(const XmlElement& element) const {
  return With(element, "", "equality");
}

MjcfElement MjcfDefaults::OfTendon(const XmlElement& element) const {
  return With(element, "", "tendon");
}

MjcfElement MjcfDefaults::OfActuator(const XmlElement& element) const {
  std::vector<XmlElement> holders = {element};
  for (const XmlElement& of_class : ClassOf(element, "")) {
    const std::vector<XmlElement> all = of_class.Children(nullptr);
    for (auto child = all.rbegin(); child != all.rend(); ++child) {
      if (std::count(kActuators.begin(), kActuators.end(), child->tag()) > 0) {
        holders.push_back(*child);
      }
    }
  }
  return MjcfElement(std::move(holders));
}

std::string MjcfDefaults::ChildClass(const XmlElement& body,
                                     const std::string& around) const {
  if (!body.Has("childclass")) return around;
  const std::string name = body.Name("childclass");
  ClassOf(body, name);
  return name;
}

}  // namespace armcal
