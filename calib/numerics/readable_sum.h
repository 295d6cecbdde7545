#pragma once

#include <string>

namespace armcal {

// A sum as parameters are named, "Izz[1] - 2.405e-10*hx[1] + armature[1]",
// without the terms that only rounding makes: those whose factors are below a
// millionth of the largest. Factors are lengths, sines and cosines of the robot
// file, which has its numbers to some six digits. For reports: files keep the
// whole name, by which they are read again.
std::string ReadableSum(const std::string& name);

// The same in brackets where it has several terms.
std::string InBrackets(const std::string& name);

}  // namespace armcal
