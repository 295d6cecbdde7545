#include "model/log_files/columns/column_spelling.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "model/log_files/columns/column_words.h"
#include "model/log_files/columns/log_signal.h"
#include "model/log_files/columns/signal_phrases.h"

namespace armcal {
namespace {

using Words = std::vector<std::string>;

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

// A name without its unit, which is in brackets of either kind behind it, or
// its last word. What is no unit stays.
std::string WithoutUnit(const std::string& name, std::string* unit) {
  const size_t open = name.find_last_of("[(");
  if (open != name.npos && open > 0 &&
      (name.back() == ']' || name.back() == ')')) {
    const auto found =
        UnitOf(std::string_view(name).substr(open + 1, name.size() - open - 2));
    if (found) {
      *unit = *found;
      return name.substr(0, open);
    }
  }
  const size_t last = name.find_last_of("_ ");
  if (last == name.npos || last == 0) return name;
  const std::string_view word = std::string_view(name).substr(last + 1);
  if (word.size() < 2 && word != "s") return name;  // q_d, tau_j
  const auto found = UnitOf(word);
  if (!found) return name;
  *unit = *found;
  return name.substr(0, last);
}

// Takes these words out of `words` where they stand together; returns how many
// stood before them, -1 if they are not there.
int TakeOut(const Words& of, Words* words) {
  const auto at =
      std::search(words->begin(), words->end(), of.begin(), of.end());
  if (of.empty() || at == words->end()) return -1;
  const auto before = at - words->begin();
  words->erase(at, at + static_cast<std::ptrdiff_t>(of.size()));
  return static_cast<int>(before);
}

std::string Joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) {
    if (IsFiller(word) && !(word == "j" && text == "tau")) continue;
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

// What a column was understood as.
struct Understood {
  Signal signal;
  int number = 0;  // as it is written
  bool by_number = false;
  std::string unit;
  std::string prefix;  // words before the joint's name that the robot has not
};

class Speller {
 public:
  explicit Speller(const std::vector<std::string>& joint_names)
      : joint_names_(joint_names) {}

  std::optional<Understood> Understand(const std::string& name) const {
    Understood column;
    Words words = ColumnWords(WithoutUnit(name, &column.unit));
    int before = 0;  // words before the joint's name
    if (!FindJoint(&words, &column, &before)) return std::nullopt;
    std::optional<Signal> signal = SignalOf(Joined(words));
    if (!signal && before > 0) {
      const auto begin = words.begin() + before;
      if (std::any_of(words.begin(), begin, TellsOtherQuantity))
        return std::nullopt;
      signal = SignalOf(Joined({begin, words.end()}));
      column.prefix = Joined({words.begin(), begin});
    }
    if (!signal) return std::nullopt;
    column.signal = *signal;
    return column;
  }

 private:
  // By the longest name, else by the only number.
  bool FindJoint(Words* words, Understood* column, int* before) const {
    size_t longest = 0;
    int named = 0;
    for (size_t i = 0; i < joint_names_.size(); ++i) {
      Words rest = *words;
      if (joint_names_[i].size() <= longest ||
          TakeOut(ColumnWords(joint_names_[i]), &rest) < 0) {
        continue;
      }
      longest = joint_names_[i].size();
      named = static_cast<int>(i) + 1;
    }
    if (named > 0) {
      *before = TakeOut(ColumnWords(joint_names_[named - 1]), words);
      column->number = named;
      return true;
    }
    const auto is_number = [](const std::string& w) { return IsDigit(w[0]); };
    const auto at = std::find_if(words->begin(), words->end(), is_number);
    if (at == words->end()) {
      column->number = 1;
      return joint_names_.size() == 1;
    }
    if (at->size() > 3 ||
        std::count_if(words->begin(), words->end(), is_number) > 1) {
      return false;
    }
    column->number = std::stoi(*at);
    column->by_number = true;
    words->erase(at);
    return true;
  }

  const std::vector<std::string>& joint_names_;
};

// A name of the time: "Time (s)", "timestamp_ns"; rostopic's "%time" is in ns.
std::optional<std::string> TimeName(const std::string& name) {
  std::string unit;
  const Words words = ColumnWords(WithoutUnit(name, &unit));
  if (words.size() != 1) return std::nullopt;
  const std::string& word = words[0];
  const bool is_other = word == "sec" || word == "seconds" || word == "stamp";
  if (!IsTimeName(word) && !is_other) return std::nullopt;
  if (name == "%time") unit = "ns";
  return unit.empty() ? "t" : "t [" + unit + "]";
}

using AllUnderstood = std::vector<std::optional<Understood>>;

// The one prefix under which every joint has a position, where none has one
// without: the log's joints have another name then, a namespace's before the
// file's. "" where there is no such prefix, or several.
std::string PrefixOfJoints(const AllUnderstood& columns, size_t joints) {
  std::map<std::string, std::set<int>> positions;  // joints of each prefix
  for (const auto& column : columns) {
    if (!column || column->signal != Signal::kPosition) continue;
    positions[column->prefix].insert(column->number);
  }
  std::string found;
  for (const auto& [prefix, numbers] : positions) {
    if (numbers.size() < joints && !prefix.empty()) continue;
    if (prefix.empty() || !found.empty()) return "";
    found = prefix;
  }
  return found;
}

// Whether columns that are numbered count from 0: all do that have numbers.
bool CountFromZero(const AllUnderstood& columns) {
  std::map<Signal, int> first;
  for (const auto& column : columns) {
    if (!column || !column->by_number) continue;
    const auto [at, is_new] = first.insert({column->signal, column->number});
    if (!is_new) at->second = std::min(at->second, column->number);
  }
  return !first.empty() &&
         std::all_of(first.begin(), first.end(),
                     [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

std::vector<std::string> SpelledOut(
    const std::vector<std::string>& names,
    const std::vector<std::string>& joint_names) {
  const Speller speller(joint_names);
  AllUnderstood columns;
  for (const std::string& name : names) {
    columns.push_back(speller.Understand(name));
  }
  const std::string prefix = PrefixOfJoints(columns, joint_names.size());
  for (std::optional<Understood>& column : columns) {
    if (column && !column->by_number && column->prefix != prefix) {
      column.reset();
    }
  }
  const int shift = CountFromZero(columns) ? 1 : 0;
  std::vector<std::string> own = names;
  for (size_t k = 0; k < names.size(); ++k) {
    if (const auto time = TimeName(names[k])) own[k] = *time;
    if (!columns[k]) continue;
    const int number = columns[k]->number + (columns[k]->by_number ? shift : 0);
    own[k] = std::string(NamesOf(columns[k]->signal).number_prefix) +
             std::to_string(number);
    if (!columns[k]->unit.empty()) own[k] += " [" + columns[k]->unit + "]";
  }
  return own;
}

}  // namespace armcal
