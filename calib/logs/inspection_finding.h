#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace armcal {

// Something about a log or a robot file that will spoil what is made of them.
struct InspectionFinding {
  std::string finding;   // one word, such as "torque_sign"
  std::string sentence;  // what is wrong
  std::string evidence;  // the figures that say so
  std::string remedy;    // the option or the header that mends it
  int joint = -1;        // from 0; -1: none, or all
  double probability = 1;
  // Where what would mend it was tried: what a fit leaves of torques that it
  // has not seen, %, without and with it. 0: it was not.
  double held_out_before = 0, held_out_after = 0;
  // What may be wrong instead: `finding` and `joint`.
  std::vector<std::pair<std::string, int>> alternatives{};
  bool leads = false;  // a diagnosis begins with it, and names nothing
};

// Those of which `is_out` is true are taken out.
template <class IsOut>
void DropFindings(const IsOut& is_out,
                  std::vector<InspectionFinding>* findings) {
  findings->erase(std::remove_if(findings->begin(), findings->end(), is_out),
                  findings->end());
}

}  // namespace armcal
