#include "model/log_files/columns/column_spelling.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "model/log_files/columns/log_signal.h"

namespace armcal {
namespace {

using Words = std::vector<std::string>;

// What signals are called beside armcal's own words (NamesOf), their words
// joined by blanks.
const std::map<std::string, Signal>& OtherPhrases() {
  static const auto* const kPhrases = new std::map<std::string, Signal>{
      {"pos", Signal::kPosition},
      {"positions", Signal::kPosition},
      {"angle", Signal::kPosition},
      {"dq", Signal::kVelocity},
      {"qdot", Signal::kVelocity},
      {"vel", Signal::kVelocity},
      {"velocities", Signal::kVelocity},
      {"speed", Signal::kVelocity},
      {"ddq", Signal::kAcceleration},
      {"acc", Signal::kAcceleration},
      {"accelerations", Signal::kAcceleration},
      {"tau j", Signal::kEffort},  // libfranka's
      {"torque", Signal::kEffort},
      {"torques", Signal::kEffort},
      {"efforts", Signal::kEffort},
      {"force", Signal::kEffort},
      {"currents", Signal::kCurrent},
      {"motor current", Signal::kCurrent},
      {"q ref", Signal::kReference},
      {"q d", Signal::kReference},  // libfranka's
      {"q des", Signal::kReference},
      {"q cmd", Signal::kReference},
      {"target q", Signal::kReference},
      {"position reference", Signal::kReference},
      {"position command", Signal::kReference},
      {"desired position", Signal::kReference},
      {"target position", Signal::kReference},
      {"commanded position", Signal::kReference},
      {"pos ref", Signal::kReference},
      {"pos des", Signal::kReference},
      {"pos cmd", Signal::kReference},
      {"temperatures", Signal::kTemperature}};
  return *kPhrases;
}

std::optional<Signal> SignalOf(const std::string& phrase) {
  for (const Signal signal : kSignals) {
    const SignalNames& names = NamesOf(signal);
    if (phrase == names.number_prefix || phrase == names.path_part)
      return signal;
  }
  const auto other = OtherPhrases().find(phrase);
  if (other == OtherPhrases().end()) return std::nullopt;
  return other->second;
}

// Words that change nothing of what a column holds.
const std::set<std::string>& Fillers() {
  static const auto* const kFillers = new std::set<std::string>{
      "joint", "joints", "j",      "axis",  "actual", "measured",
      "meas",  "state",  "states", "field", "robot"};
  return *kFillers;
}

// Units by how else they are written, as Plain() has them.
const std::map<std::string, std::string>& OtherUnits() {
  static const auto* const kUnits = new std::map<std::string, std::string>{
      {"radian", "rad"},     {"radians", "rad"},    {"degree", "deg"},
      {"degrees", "deg"},    {"\u00b0", "deg"},     {"\u00b0/s", "deg/s"},
      {"rad/s2", "rad/s^2"}, {"deg/s2", "deg/s^2"}, {"amp", "A"},
      {"amps", "A"},         {"\u00b0c", "degC"},   {"sec", "s"},
      {"secs", "s"},         {"seconds", "s"}};
  return *kUnits;
}

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)); }
bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

// Runs of letters and of digits, in lower case.
Words WordsOf(std::string_view text) {
  Words words;
  char before = ' ';
  for (const char c : text) {
    const bool goes_on =
        (IsLetter(c) && IsLetter(before)) || (IsDigit(c) && IsDigit(before));
    if (IsLetter(c) || IsDigit(c)) {
      if (!goes_on) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(c));
    }
    before = c;
  }
  return words;
}

// In lower case, without blanks, dots and stars.
std::string Plain(std::string_view unit) {
  std::string plain;
  for (const char c : unit) {
    if (c != ' ' && c != '.' && c != '*') {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return plain;
}

std::optional<std::string> UnitOf(std::string_view text) {
  const std::string plain = Plain(text);
  int decimals = 0;
  if (plain.empty()) return std::nullopt;
  if (FindTimeUnit(plain, &decimals)) return plain;
  for (const Signal signal : kSignals) {
    for (const Unit& unit : NamesOf(signal).units) {
      if (Plain(unit.name) == plain) return std::string(unit.name);
    }
  }
  const auto other = OtherUnits().find(plain);
  if (other == OtherUnits().end()) return std::nullopt;
  return other->second;
}

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

// Takes these words out of `words` where they stand together.
bool TakeOut(const Words& of, Words* words) {
  const auto at =
      std::search(words->begin(), words->end(), of.begin(), of.end());
  if (of.empty() || at == words->end()) return false;
  words->erase(at, at + static_cast<std::ptrdiff_t>(of.size()));
  return true;
}

std::string Joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) {
    if (Fillers().count(word) > 0 && !(word == "j" && text == "tau")) continue;
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
};

class Speller {
 public:
  explicit Speller(const std::vector<std::string>& joint_names)
      : joint_names_(joint_names) {}

  std::optional<Understood> Understand(const std::string& name) const {
    Understood column;
    Words words = WordsOf(WithoutUnit(name, &column.unit));
    if (!FindJoint(&words, &column)) return std::nullopt;
    const std::optional<Signal> signal = SignalOf(Joined(words));
    if (!signal) return std::nullopt;
    column.signal = *signal;
    return column;
  }

 private:
  // By the longest name, else by the only number.
  bool FindJoint(Words* words, Understood* column) const {
    size_t longest = 0;
    int named = 0;
    for (size_t i = 0; i < joint_names_.size(); ++i) {
      Words rest = *words;
      if (joint_names_[i].size() <= longest ||
          !TakeOut(WordsOf(joint_names_[i]), &rest)) {
        continue;
      }
      longest = joint_names_[i].size();
      named = static_cast<int>(i) + 1;
    }
    if (named > 0) {
      TakeOut(WordsOf(joint_names_[named - 1]), words);
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
  const Words words = WordsOf(WithoutUnit(name, &unit));
  if (words.size() != 1) return std::nullopt;
  if (!IsTimeName(words[0]) && words[0] != "sec" && words[0] != "seconds")
    return std::nullopt;
  if (name == "%time") unit = "ns";
  return unit.empty() ? "t" : "t [" + unit + "]";
}

// Whether columns that are numbered count from 0: all do that have numbers.
bool CountFromZero(const std::vector<std::optional<Understood>>& columns) {
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
  std::vector<std::optional<Understood>> columns;
  for (const std::string& name : names) {
    columns.push_back(speller.Understand(name));
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
