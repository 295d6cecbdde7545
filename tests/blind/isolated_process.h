#pragma once

#include <string>
#include <vector>

namespace armcal {

// How a process ended.
struct ProcessEnd {
  bool timed_out = false;
  int exit_code = -1;  // -1: by a signal, or never started
  double seconds = 0;  // that it took, wall clock
  double cpu_seconds = 0;
};

// Whether processes can be given another user's rights: ours are root's.
bool CanIsolate();

// Runs a program in a folder, as the user nobody where we are root: it reads
// what everybody may and writes what is its own. Its output goes to `output` in
// that folder. After timeout_s it is killed with all that it started.
ProcessEnd RunIsolated(const std::vector<std::string>& command,
                       const std::string& folder, const std::string& output,
                       double timeout_s);

// Gives a file or folder to that user; nothing where we are not root.
void GiveAway(const std::string& path);

}  // namespace armcal
