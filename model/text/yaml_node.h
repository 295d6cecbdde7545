#pragma once

#include <yaml-cpp/node/node.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "model/text/document.h"

namespace armcal {

// A node of a YAML file, read strictly: what is not as asked throws InputError
// with file, line and key ("links[2].mass", counted from 1), the value and what
// was expected.
class YamlNode {
 public:
  // What the file, or the text, is of: one YAML document.
  static YamlNode ReadFile(const Document& file);

  // Requires a map with no other keys than `known` and none of them twice.
  void ExpectKeys(const std::vector<std::string>& known) const;
  // The value at `key` of a map, if any.
  std::optional<YamlNode> Child(const std::string& key) const;
  YamlNode RequiredChild(const std::string& key) const;
  // The entries of a sequence.
  std::vector<YamlNode> Entries() const;

  // A text that is not empty and has no control characters.
  std::string Name() const;
  // One of `allowed`.
  std::string Choice(const std::vector<std::string>& allowed) const;
  // Several of `allowed`, none of them twice.
  std::vector<std::string> Choices(
      const std::vector<std::string>& allowed) const;
  // Finite numbers; `unit` ("kg") is for messages.
  double Number(const std::string& unit) const;
  double NonNegative(const std::string& unit) const;
  Eigen::VectorXd Vector(const std::string& unit) const;
  Eigen::Vector3d Vector3(const std::string& unit) const;

  [[noreturn]] void Refuse(const std::string& expected) const;

 private:
  YamlNode(const std::string& file, const std::string& key, int line,
           const YAML::Node& node)
      : file_(file), key_(key), line_(line), node_(node) {}

  std::string file_;
  std::string key_;  // from the root, such as "links[2].mass"
  int line_ = 0;     // 0: unknown
  YAML::Node node_;
};

}  // namespace armcal
