#pragma once

#include <gflags/gflags.h>

#include <cstdio>
#include <exception>

namespace armcal {

// main() of a program of the bench: what is wrong with its input goes to stderr
// in one line, exit code 3.
inline int RunBlindProgram(const char* name, int (*run)(), int argc,
                           char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 3;
  }
}

}  // namespace armcal
