#pragma once

#include <string>

namespace armcal {

// Of armcal and of the libraries that its numbers depend on, for people.
std::string VersionText();

// Throws InputError where a library is not one that armcal can call: another
// one than it was compiled with, in a way that matters.
void CheckLibraryVersions();

}  // namespace armcal
