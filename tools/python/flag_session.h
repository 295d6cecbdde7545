#pragma once

#include <gflags/gflags.h>

#include <map>
#include <mutex>
#include <string>

#include "tools/command.h"

namespace armcal {

using FlagTexts = std::map<std::string, std::string>;

// The command of this name. Throws UsageError.
const Command& CommandNamed(const std::string& name);

// The flags of a command, set as its command line would, until this ends; the
// process has them once, so that other threads wait for it. Needs no GIL, but
// while it waits it lets Python's signals through. Throws UsageError for flags
// that the command does not take, and in a thread that has a session already
// (a progress that starts a command).
class FlagSession {
 public:
  FlagSession(const Command& command, const FlagTexts& flags);
  ~FlagSession();
  FlagSession(const FlagSession&) = delete;
  FlagSession& operator=(const FlagSession&) = delete;

 private:
  std::unique_lock<std::timed_mutex> lock_;
  gflags::FlagSaver saver_;  // sets them back before the lock ends
};

}  // namespace armcal
