#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace armcal {

// What `make` returns, made in a process of its own: a copy of this one that
// may read files and take memory but not write, start or signal anything, or
// reach a network (seccomp, x86-64 and arm64), and that has none of this one's
// open files, and at most `memory` bytes more than it. For libraries whose
// parsers hostile files get the better of. Nothing where that process died.
struct Confined {
  std::string made;
  std::string refusal;  // the message of an InputError of `make`
};
std::optional<Confined> MakeConfined(std::uint64_t memory,
                                     const std::function<std::string()>& make);

}  // namespace armcal
