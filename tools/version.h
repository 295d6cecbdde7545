#pragma once

#include <string>

namespace armcal {

// Of armcal and of the libraries that its numbers depend on, for people.
std::string VersionText();

}  // namespace armcal
