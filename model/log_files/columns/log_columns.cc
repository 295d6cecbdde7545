#include "model/log_files/columns/log_columns.h"

#include <algorithm>
#include <set>
#include <utility>

#include "model/log_files/columns/column_spelling.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

bool HoldsTime(std::string_view names, char separator) {
  while (!names.empty()) {
    const size_t end = std::min(names.find(separator), names.size());
    if (IsTimeName(names.substr(0, end))) return true;
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return false;
}

// The separator that the header holds most often; a space where there is no
// other, as numpy.savetxt and UR's recorder have it, if that makes a header.
char FindSeparator(std::string_view header) {
  const auto count = [&](char c) {
    return std::count(header.begin(), header.end(), c);
  };
  char best = ',';
  for (char c : {';', '\t'}) {
    if (count(c) > count(best)) best = c;
  }
  if (count(best) == 0 && HoldsTime(header, ' ')) return ' ';
  return best;
}

// Adds an item to a list that reads "a, b, c".
void AddTo(std::string* list, std::string_view item) {
  if (!list->empty()) *list += ", ";
  *list += item;
}

bool EndsWithPart(std::string_view path, std::string_view part) {
  if (path.size() < part.size()) return false;
  const size_t rest = path.size() - part.size();
  return path.substr(rest) == part && (rest == 0 || path[rest - 1] == '/');
}

// JSON begins with an object or a list, and what stands in it with a quote, a
// number, another object or list, or on the next line. No column is named so.
bool IsJson(std::string_view header) {
  if (header.empty() || (header[0] != '{' && header[0] != '[')) return false;
  const std::string_view inside = Trim(header.substr(1), " \t");
  return inside.empty() ||
         std::string_view("\"'{[}]-0123456789").find(inside[0]) !=
             std::string_view::npos;
}

}  // namespace

LogColumns::LogColumns(const std::string& file, std::string_view header,
                       const std::vector<std::string>& joint_names,
                       const std::string& about, Bare bare)
    : file_(file), about_(about), bare_(bare), joint_names_(joint_names) {
  // numpy.savetxt makes the header a comment.
  if (!header.empty() && header.front() == '#') header.remove_prefix(1);
  header = Trim(header, " ");
  if (IsJson(header)) {
    Refuse(
        "is JSON, expected CSV, NumPy's .npz, MATLAB's .mat or a bag of ROS 2: "
        "load it in Python and write its lists with numpy.savez, or its "
        "records with pandas.DataFrame(records).to_csv");
  }
  separator_ = FindSeparator(header);
  for (size_t begin = 0; begin <= header.size();) {
    const size_t end = std::min(header.find(separator_, begin), header.size());
    names_.emplace_back(Trim(header.substr(begin, end - begin), " \""));
    begin = end + 1;
  }
  if (header.find('\r') != header.npos) {
    Refuse("the lines end in CR alone; save the file with LF or CRLF");
  }
  if (Trim(header, " \"").empty()) {
    Refuse("the row is empty, expected names of columns, as in t,q1,tau1");
  }
  if (std::all_of(names_.begin(), names_.end(),
                  [](const auto& name) { return ParseNumber(name); })) {
    Refuse("expected a header that names the columns, as in t,q1,tau1");
  }
  if (size() == 1) {
    Refuse("expected several columns separated by , ; or TAB, found " +
           Quoted(names_[0]));
  }
  Understand(OwnNames(names_));
  const auto drives = [this] {
    return HasAny(Signal::kEffort) || HasAny(Signal::kCurrent) ||
           HasAny(Signal::kVoltage);
  };
  const bool moves = HasPositionsInTime();
  if (moves && drives()) return;
  const std::vector<std::string> own_names = own_names_;
  Understand(SpelledOut(names_, joint_names_));
  is_spelled_out_ = HasPositionsInTime() && (!moves || drives());
  if (!is_spelled_out_) Understand(own_names);
}

void LogColumns::Understand(std::vector<std::string> own_names) {
  own_names_ = std::move(own_names);
  time_columns_.clear();
  matches_.clear();
  for (int i = 0; i < size(); ++i) Classify(i);
  if (bare_ == Bare::kPosition) AddBarePositions();
}

// Of joints whose positions no other column has: what is called as a joint of a
// portal, x, may be measured.
void LogColumns::AddBarePositions() {
  const auto positions = [this](int number) {
    return std::any_of(matches_.begin(), matches_.end(), [&](const Match& m) {
      return m.signal == Signal::kPosition && m.number == number;
    });
  };
  for (int number = 1; number <= static_cast<int>(joint_names_.size());
       ++number) {
    if (positions(number)) continue;
    for (int i = 0; i < size(); ++i) {
      std::string_view unit;
      const std::string_view base = SplitUnit(own_names_[i], &unit);
      if (base != joint_names_[number - 1]) continue;
      Add({i, Signal::kPosition, number, false}, unit);
    }
  }
}

bool LogColumns::IsOfAJoint(int index) const {
  return std::any_of(matches_.begin(), matches_.end(),
                     [index](const Match& m) { return m.index == index; });
}

bool LogColumns::HasPositionsInTime() const {
  return time_columns_.size() == 1 && HasAll(Signal::kPosition);
}

bool LogColumns::simulated() const {
  return std::find(names_.begin(), names_.end(), kSimulated) != names_.end();
}

void LogColumns::Classify(int index) {
  std::string_view unit;
  const std::string_view base = SplitUnit(own_names_[index], &unit);
  if (IsTimeName(base)) {
    time_columns_.push_back(index);
    return;
  }
  for (Signal signal : kSignals) {
    const int number = NumberBetween(NamesOf(signal).number_prefix, "", base);
    if (number >= 0) return Add({index, signal, number, true}, unit);
  }
  const size_t slash = base.rfind('/');
  if (slash == base.npos) return;
  const int number = FindJoint(base.substr(0, slash));
  if (number == 0) return;
  for (Signal signal : kSignals) {
    if (base.substr(slash + 1) == NamesOf(signal).path_part) {
      return Add({index, signal, number, false}, unit);
    }
  }
}

void LogColumns::Add(Match match, std::string_view unit) {
  if (match.signal == Signal::kEffort) {
    for (const Signal other : {Signal::kCurrent, Signal::kVoltage}) {
      if (FindUnit(other, unit)) match.signal = other;
    }
  }
  matches_.push_back(match);
}

int LogColumns::FindJoint(std::string_view path) const {
  // A joint name may itself be a path; then the longest match is meant.
  size_t longest = 0;
  int number = 0;
  for (size_t i = 0; i < joint_names_.size(); ++i) {
    const std::string& name = joint_names_[i];
    if (name.size() <= longest || !EndsWithPart(path, name)) continue;
    longest = name.size();
    number = static_cast<int>(i) + 1;
  }
  return number;
}

std::vector<LogColumns::Match> LogColumns::Matches(Signal signal,
                                                   int number) const {
  std::vector<Match> found;
  for (const Match& match : matches_) {
    if (match.signal == signal && match.number == number) {
      found.push_back(match);
    }
  }
  return found;
}

int LogColumns::FindTime(int* unit_decimals) const {
  if (time_columns_.empty()) {
    Refuse("no time column: expected t, time, timestamp or __time" +
           Unrecognised());
  }
  const std::string& name = names_[time_columns_[0]];
  if (time_columns_.size() > 1) {
    Refuse("two time columns, " + Quoted(name) + " and " +
           Quoted(names_[time_columns_[1]]) + "; rename one");
  }
  std::string_view unit;
  SplitUnit(own_names_[time_columns_[0]], &unit);
  if (FindTimeUnit(unit, unit_decimals)) return time_columns_[0];
  Refuse("column " + Quoted(name) + ": expected a unit of s, ms, us or ns");
}

bool LogColumns::HasAny(Signal signal) const {
  return std::any_of(matches_.begin(), matches_.end(),
                     [&](const Match& m) { return m.signal == signal; });
}

bool LogColumns::HasAll(Signal signal) const { return Missing(signal).empty(); }

std::string LogColumns::Missing(Signal signal) const {
  const SignalNames& names = NamesOf(signal);
  std::string missing;
  for (size_t i = 0; i < joint_names_.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    if (!Matches(signal, number).empty()) continue;
    AddTo(&missing, std::string(names.number_prefix) + std::to_string(number) +
                        " or " + joint_names_[i] + "/" +
                        std::string(names.path_part));
  }
  return missing;
}

std::vector<LogColumn> LogColumns::Find(Signal signal,
                                        const std::string& advice) const {
  CheckJointCount(signal);
  const std::string missing = Missing(signal);
  if (!missing.empty()) {
    Refuse("missing " + missing + "; " + CountsOf(signal) + Unrecognised() +
           advice);
  }
  std::vector<LogColumn> columns;
  for (size_t i = 0; i < joint_names_.size(); ++i) {
    const auto found = Matches(signal, static_cast<int>(i) + 1);
    const std::string& name = names_[found[0].index];
    if (found.size() > 1) {
      Refuse("two columns for the " + std::string(NamesOf(signal).path_part) +
             " of joint " + joint_names_[i] + ", " + Quoted(name) + " and " +
             Quoted(names_[found[1].index]) + "; rename one");
    }
    columns.push_back({found[0].index, UnitScale(signal, found[0].index)});
  }
  return columns;
}

double LogColumns::UnitScale(Signal signal, int index) const {
  std::string_view unit;
  SplitUnit(own_names_[index], &unit);
  if (unit.empty()) return 1;
  if (const Unit* known = FindUnit(signal, unit)) return known->scale;
  std::string units;
  for (const Unit& known : NamesOf(signal).units) AddTo(&units, known.name);
  Refuse("column " + Quoted(names_[index]) + ": expected a unit of " + units);
}

std::set<int> LogColumns::Numbers(Signal signal) const {
  std::set<int> numbers;
  for (const Match& match : matches_) {
    if (match.signal == signal && match.by_number) numbers.insert(match.number);
  }
  return numbers;
}

// A robot with fewer joints than the log is as wrong as one with more; the
// first columns would fit and mean other joints.
void LogColumns::CheckJointCount(Signal signal) const {
  const std::set<int> numbers = Numbers(signal);
  if (numbers.empty()) return;
  const int joints = static_cast<int>(joint_names_.size());
  const auto in_range = numbers.lower_bound(1);
  if (in_range == numbers.end() || *in_range > joints) return;
  if (*numbers.begin() < 1) {
    Refuse("joints are numbered from 1; " + CountsOf(signal));
  }
  if (*numbers.rbegin() > joints) {
    Refuse("wrong number of joints: " + CountsOf(signal));
  }
}

std::string LogColumns::CountsOf(Signal signal) const {
  const std::string prefix(NamesOf(signal).number_prefix);
  const size_t joints = joint_names_.size();
  std::string text = "the robot has " + std::to_string(joints) +
                     (joints == 1 ? " joint" : " joints") + ", the log holds ";
  const std::set<int> numbers = Numbers(signal);
  if (numbers.empty()) {
    const auto count =
        std::count_if(matches_.begin(), matches_.end(),
                      [&](const Match& m) { return m.signal == signal; });
    return text + std::to_string(count) + " such columns";
  }
  const int first = *numbers.begin();
  const int last = *numbers.rbegin();
  if (last > first && last - first + 1 == static_cast<int>(numbers.size())) {
    return text + prefix + std::to_string(first) + ".." + prefix +
           std::to_string(last);
  }
  std::string list;
  for (int number : numbers) AddTo(&list, prefix + std::to_string(number));
  return text + list;
}

std::string LogColumns::Named(Signal signal) const {
  std::string first, last;
  for (const Match& match : matches_) {
    if (match.signal != signal) continue;
    last = names_[match.index];
    if (first.empty()) first = last;
  }
  return first == last ? first : first + " to " + last;
}

std::string LogColumns::Spelling() const {
  std::string text;
  if (!is_spelled_out_) return text;
  for (const Signal signal : kSignals) {
    const std::string prefix(NamesOf(signal).number_prefix);
    const std::string named = Named(signal);
    if (named.empty() || named.rfind(prefix + "1", 0) == 0) continue;
    AddTo(&text, prefix + " is " + named);
  }
  return text;
}

std::string LogColumns::Unrecognised() const {
  constexpr int kShown = 6;
  std::string list;
  int count = 0;
  for (int i = 0; i < size(); ++i) {
    const bool known =
        std::count(time_columns_.begin(), time_columns_.end(), i) > 0 ||
        std::any_of(matches_.begin(), matches_.end(),
                    [&](const Match& m) { return m.index == i; });
    if (known || names_[i].empty()) continue;
    if (++count <= kShown) AddTo(&list, Quoted(names_[i]));
  }
  const std::string about = about_.empty() ? "" : "; " + about_;
  if (count == 0) return about;
  if (count > kShown) AddTo(&list, std::to_string(count - kShown) + " more");
  return "; not recognised: " + list + about;
}

void LogColumns::Refuse(const std::string& expected) const {
  throw InputError(file_, "row 1", "", expected);
}

}  // namespace armcal
