#pragma once

#include <string>
#include <vector>

namespace armcal {

// The entry of `names` that `name` was probably meant to be: at most three
// letters differ. Empty where none is near.
std::string NearestName(const std::string& name,
                        const std::vector<std::string>& names);

// "; did you mean --log?" where `before` is "--"; empty where none is near.
std::string DidYouMean(const std::string& name,
                       const std::vector<std::string>& names,
                       const std::string& before = "");

}  // namespace armcal
