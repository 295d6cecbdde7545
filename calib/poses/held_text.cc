#include "calib/poses/held_text.h"

#include <utility>

namespace armcal {
namespace {

constexpr size_t kFewSentences = 2;

// "elbow.x" and what is said of it, after a blank.
std::pair<std::string, std::string> Split(const std::string& sentence) {
  const size_t blank = sentence.find(' ');
  if (blank == std::string::npos) return {sentence, ""};
  return {sentence.substr(0, blank), sentence.substr(blank)};
}

// "shoulder.x .y" and "elbow.x": parameters with their links, a line each.
std::string ByLink(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, std::string>> links;
  for (const std::string& name : names) {
    const size_t dot = name.rfind('.');
    const std::string link = name.substr(0, dot);
    const std::string field = dot == std::string::npos ? "" : name.substr(dot);
    size_t k = 0;
    while (k < links.size() && links[k].first != link) ++k;
    if (k == links.size()) {
      links.emplace_back(link, field);
    } else {
      links[k].second += " " + field;
    }
  }
  std::string text;
  for (const auto& [link, fields] : links) {
    text += "           " + link + fields + "\n";
  }
  return text;
}

}  // namespace

std::string HeldText(const std::vector<std::string>& sentences) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;
  for (const std::string& sentence : sentences) {
    const auto [name, what] = Split(sentence);
    size_t k = 0;
    while (k < said.size() && said[k].first != what) ++k;
    if (k == said.size()) said.emplace_back(what, std::vector<std::string>{});
    said[k].second.push_back(name);
  }
  std::string text;
  for (const auto& [what, names] : said) {
    if (names.size() > kFewSentences) {
      text += "held       " + std::to_string(names.size()) +
              " parameters, each of which" + what + ":\n" + ByLink(names);
      continue;
    }
    for (const std::string& name : names) {
      text += "held       " + name + what + "\n";
    }
  }
  return text;
}

}  // namespace armcal
