#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/log_files/columns/log_signal.h"

namespace armcal {

// A field of each row and the factor that brings it to SI units.
struct LogColumn {
  int index = 0;  // 0-based
  double scale = 1;
};

// Reads the header line of a log: which field holds what, in which unit. The
// accepted names are listed in log_reader.h. Where these do not give the time,
// all positions and some torque or current, other spellings are tried
// (column_spelling.h) and taken if they do. All other columns are left alone,
// whatever they hold.
class LogColumns {
 public:
  // What a column is that is called as a joint, without any signal: in a log
  // it may be anything, in a file of poses only the joint's position.
  enum class Bare { kNothing, kPosition };
  // `file` is for messages, `about` for those on missing columns. Throws
  // InputError where there is no header.
  LogColumns(const std::string& file, std::string_view header,
             const std::vector<std::string>& joint_names,
             const std::string& about = "", Bare bare = Bare::kNothing);

  char separator() const { return separator_; }
  // Fields in a row.
  int size() const { return static_cast<int>(names_.size()); }
  // Whether the log says that a simulation has written it: a column of this
  // name, whatever it holds.
  static constexpr char kSimulated[] = "simulated";
  bool simulated() const;
  // As the header has it, with the unit.
  const std::string& name(int index) const { return names_[index]; }

  // The time column. It counts in 10^-unit_decimals s.
  int FindTime(int* unit_decimals) const;
  // Whether any joint, or every joint, has a column for this signal.
  bool HasAny(Signal signal) const;
  bool HasAll(Signal signal) const;
  // One column per joint, base to tip. Throws InputError where one is missing,
  // where two would do, where the unit is unknown, and where the log numbers
  // joints that the robot lacks. `advice` ends the message of the first case.
  std::vector<LogColumn> Find(Signal signal,
                              const std::string& advice = "") const;
  // The columns Find() looks for where there are none: "tau2 or elbow/effort".
  std::string Missing(Signal signal) const;
  // The columns that it has of a signal, as its header names them: "i1 to i6".
  std::string Named(Signal signal) const;
  // Where the header spells names in its own way (SpelledOut) how they were
  // understood, "q is pos_0 to pos_5, tau is ..."; else empty.
  std::string Spelling() const;
  // Whether a column is a joint's.
  bool IsOfAJoint(int index) const;
  // What else the file has, which ends messages on missing columns: "; not
  // recognised: ...".
  std::string Unrecognised() const;

 private:
  struct Match {
    int index;  // of the column
    Signal signal;
    int number;      // 1-based joint number
    bool by_number;  // q3, not elbow/position
  };

  void Understand(std::vector<std::string> own_names);
  bool HasPositionsInTime() const;
  void Classify(int index);
  void AddBarePositions();
  void Add(Match match, std::string_view unit);
  // The 1-based number of the joint that a path ends with; 0 for none.
  int FindJoint(std::string_view path) const;
  std::vector<Match> Matches(Signal signal, int number) const;
  double UnitScale(Signal signal, int index) const;
  std::set<int> Numbers(Signal signal) const;
  void CheckJointCount(Signal signal) const;
  // "the robot has 7 joints, the log holds q1..q6".
  std::string CountsOf(Signal signal) const;
  [[noreturn]] void Refuse(const std::string& expected) const;

  std::string file_, about_;
  Bare bare_;
  std::vector<std::string> joint_names_;
  char separator_ = ',';
  std::vector<std::string> names_;
  std::vector<std::string> own_names_;  // armcal's, which tell the units too
  bool is_spelled_out_ = false;
  std::vector<int> time_columns_;
  std::vector<Match> matches_;
};

}  // namespace armcal
