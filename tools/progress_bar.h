#pragma once

#include <chrono>
#include <string>

namespace armcal {

// A progress bar on stderr: only where that is a terminal (and TERM is not
// dumb, CI not set), only for work of over a second, at most ten times a
// second.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  // clears the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Show(const std::string& stage, double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point start_, last_;
};

}  // namespace armcal
