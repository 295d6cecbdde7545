#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "tools/flag_file.h"

namespace armcal {

// What the flags of one run of a command are. gflags' DEFINE_.. say each flag's
// name, type, meaning and default; their values, of which a process has one
// set, are nobody's: commands read these, so that several can run at once. A
// flag that is not given, or that the command does not take, has its default.
class FlagValues {
 public:
  FlagValues() = default;
  // `names`: the flags that the command takes, in the order of --help. Of a
  // flag that is given twice the last value counts. Throws UsageError, which
  // begins with the flag's place, for a text that is no value of the flag's
  // type.
  FlagValues(std::vector<std::string> names,
             const std::vector<GivenFlag>& given);

  // Of flags that are defined so; another type is a bug.
  std::string Text(const std::string& name) const;
  double Number(const std::string& name) const;
  int Whole(const std::string& name) const;         // DEFINE_int32
  uint64_t Natural(const std::string& name) const;  // DEFINE_uint64
  bool Switch(const std::string& name) const;

  // Whether it is not given; given as what is the default, it is.
  bool IsDefault(const std::string& name) const;

  // "--trust=0.29999999999999999": those that are given, as they would be
  // typed, in the order of --help.
  std::vector<std::string> AsTyped() const;

 private:
  using Value = std::variant<std::string, double, int, uint64_t, bool>;

  template <class T>
  T Get(const std::string& name) const;

  std::vector<std::string> names_;
  std::map<std::string, Value> given_;
};

}  // namespace armcal
