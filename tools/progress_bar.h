#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace armcal {

// What is being done, how long, and how long this step will take: on stderr,
// only where that is a terminal (and TERM is not dumb, CI not set), only for
// work of over a second, twice a second.
class ProgressBar {
 public:
  // `stage`: what is done until Show() says otherwise.
  explicit ProgressBar(const std::string& stage);
  ~ProgressBar();  // clears the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // A fraction below 0: nobody knows.
  void Show(const std::string& stage, double fraction);
  // Show(), for the library to call; only while the bar lives.
  std::function<void(const std::string&, double)> Callback();

 private:
  using Clock = std::chrono::steady_clock;
  void Draw();
  std::string Line(Clock::time_point now) const;

  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;  // of what follows
  std::string stage_;
  double fraction_ = -1;  // unknown
  Clock::time_point stage_start_ = start_, told_ = start_;
  bool over_ = false;
  std::condition_variable ended_;
  std::thread drawing_;
};

// Clears the line of the bar, which shows nothing from then on: before anything
// else is printed. Safe in a signal's handler.
void EndProgress();

// "0:07", "1:05:09".
std::string ClockText(double seconds);

}  // namespace armcal
