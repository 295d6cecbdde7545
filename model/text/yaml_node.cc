#include "model/text/yaml_node.h"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr long kMaxYamlBytes = 1L << 20;

int Line(const YAML::Mark& mark) { return mark.is_null() ? 0 : mark.line + 1; }

std::string Place(int line, const std::string& key) {
  std::string place;
  if (line > 0) place = "line " + std::to_string(line);
  if (!key.empty()) place += (place.empty() ? "" : ", ") + OneLine(key);
  return place;
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class IgnoreEvents : public YAML::EventHandler {
  using Mark = YAML::Mark;
  using Text = std::string;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;
  void OnDocumentStart(const Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, Anchor) override {}
  void OnAlias(const Mark&, Anchor) override {}
  void OnScalar(const Mark&, const Text&, Anchor, const Text&) override {}
  void OnSequenceStart(const Mark&, const Text&, Anchor, Style) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark&, const Text&, Anchor, Style) override {}
  void OnMapEnd() override {}
};

// YAML::Load ignores what follows the first document, and YAML::LoadAll (0.7)
// never returns where that is a stray token such as "}".
bool HasOneDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  IgnoreEvents ignore;
  return parser.HandleNextDocument(ignore) &&
         !parser.HandleNextDocument(ignore);
}

// The values of a short list, "[0, 1]".
std::string ListText(const YAML::Node& list) {
  constexpr size_t kMost = 10;
  std::string text;
  for (size_t k = 0; k < std::min(list.size(), kMost); ++k) {
    if (!list[k].IsScalar()) return "";
    text += (k > 0 ? ", " : "") + list[k].Scalar();
  }
  return list.size() > kMost ? "" : "[" + text + "]";
}

}  // namespace

YamlNode YamlNode::ReadFile(const Document& file) {
  const std::string& path = file.name();
  const std::string text = file.Text(kMaxYamlBytes);
  try {
    if (!HasOneDocument(text)) {
      throw InputError(path, "", "",
                       "expected one YAML document and nothing after it");
    }
    const YAML::Node root = YAML::Load(text);
    return YamlNode(path, "", Line(root.Mark()), root);
  } catch (const YAML::DeepRecursion& error) {
    throw InputError(path, Place(Line(error.mark), ""), "",
                     "lists and maps are nested too deeply");
  } catch (const YAML::Exception& error) {
    throw InputError(path, Place(Line(error.mark), ""), "",
                     "not well-formed YAML (" + OneLine(error.msg) + ")");
  }
}

void YamlNode::ExpectKeys(const std::vector<std::string>& known) const {
  const std::string list = JoinNames(known);
  if (!node_.IsMap()) Refuse("expected a map with the keys " + list);
  std::set<std::string> seen;
  for (const auto& item : node_) {
    const std::string key = item.first.IsScalar() ? item.first.Scalar() : "";
    const YamlNode at(file_, key_, Line(item.first.Mark()), item.first);
    if (!Contains(known, key)) at.Refuse("expected one of the keys " + list);
    if (!seen.insert(key).second) at.Refuse("the key is given twice");
  }
}

std::optional<YamlNode> YamlNode::Child(const std::string& key) const {
  if (!node_.IsMap()) return std::nullopt;
  for (const auto& item : node_) {
    if (!item.first.IsScalar() || item.first.Scalar() != key) continue;
    // yaml-cpp places an absent value ("mass:") at whatever follows it.
    const YAML::Node& marked = item.second.IsNull() ? item.first : item.second;
    return YamlNode(file_, key_.empty() ? key : key_ + "." + key,
                    Line(marked.Mark()), item.second);
  }
  return std::nullopt;
}

YamlNode YamlNode::RequiredChild(const std::string& key) const {
  const std::optional<YamlNode> child = Child(key);
  if (!child) Refuse("expected a key '" + key + "'");
  return *child;
}

std::vector<YamlNode> YamlNode::Entries() const {
  if (!node_.IsSequence()) Refuse("expected a list");
  std::vector<YamlNode> entries;
  for (const YAML::Node& entry : node_) {
    // People count links from 1.
    const std::string number = std::to_string(entries.size() + 1);
    entries.push_back(
        YamlNode(file_, key_ + "[" + number + "]", Line(entry.Mark()), entry));
  }
  return entries;
}

std::string YamlNode::Name() const {
  if (!node_.IsScalar()) Refuse("expected a name");
  const std::string name = node_.Scalar();
  if (SplitWords(name).empty()) Refuse("expected a name");
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      Refuse("expected a name without control characters");
    }
  }
  return name;
}

std::string YamlNode::Choice(const std::vector<std::string>& allowed) const {
  if (!node_.IsScalar() || !Contains(allowed, node_.Scalar())) {
    Refuse("expected one of " + JoinNames(allowed));
  }
  return node_.Scalar();
}

std::vector<std::string> YamlNode::Choices(
    const std::vector<std::string>& allowed) const {
  std::vector<std::string> choices;
  for (const YamlNode& entry : Entries()) {
    const std::string choice = entry.Choice(allowed);
    if (Contains(choices, choice)) entry.Refuse("the name is given twice");
    choices.push_back(choice);
  }
  return choices;
}

double YamlNode::Number(const std::string& unit) const {
  double value = 0;
  const std::string text = node_.IsScalar() ? node_.Scalar() : "";
  const std::string why = WhyNotNumbers(text, 1, unit, &value);
  if (!why.empty()) Refuse(why);
  return value;
}

double YamlNode::NonNegative(const std::string& unit) const {
  const double value = Number(unit);
  if (value < 0) {
    Refuse("expected a number in " + unit + " that is not negative");
  }
  return value;
}

Eigen::VectorXd YamlNode::Vector(const std::string& unit) const {
  if (!node_.IsSequence()) Refuse("expected a list of numbers in " + unit);
  Eigen::VectorXd vector(node_.size());
  int i = 0;
  for (const YamlNode& entry : Entries()) vector[i++] = entry.Number(unit);
  return vector;
}

Eigen::Vector3d YamlNode::Vector3(const std::string& unit) const {
  if (!node_.IsSequence() || node_.size() != 3) {
    Refuse("expected a list of three numbers in " + unit);
  }
  return Vector(unit);
}

void YamlNode::Refuse(const std::string& expected) const {
  std::string found;
  if (node_.IsScalar()) found = node_.Scalar();
  if (node_.IsSequence()) {
    found = ListText(node_);
    if (found.empty()) found = "a list of " + std::to_string(node_.size());
  }
  throw InputError(file_, Place(line_, key_), OneLine(found), expected);
}

}  // namespace armcal
