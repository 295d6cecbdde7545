#pragma once

#include <string>

namespace armcal {

// What a flag's definition says, for help, manual and completion.
struct FlagText {
  explicit FlagText(const std::string& flag);

  // "--robot=FILE", "--select".
  std::string Form() const;
  // With the default, where there is one.
  std::string Sentence() const;

  std::string name;
  std::string value;  // FILE, A[,B...]; empty for a switch
  std::string description, default_value;
};

}  // namespace armcal
