#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/blind/blind_label.h"

namespace armcal {

// Which effects no diagnosis can tell apart on an arm, by arm: pairs whose
// torques are alike (|cos| >= 0.95) once what the model may vary has been
// fitted to them. Computed by write_equivalents from calibration motions.
class Equivalents {
 public:
  Equivalents() = default;  // none
  // Throws InputError where the file is not as write_equivalents has it.
  explicit Equivalents(const std::string& path);

  void Add(const std::string& arm, const NamedEffect& a, const NamedEffect& b,
           double cosine);
  bool Hold(const std::string& arm, const NamedEffect& a,
            const NamedEffect& b) const;

  struct Pair {
    NamedEffect a, b;
    double cosine;
  };
  const std::map<std::string, std::vector<Pair>>& arms() const { return arms_; }

 private:
  std::map<std::string, std::vector<Pair>> arms_;
};

}  // namespace armcal
