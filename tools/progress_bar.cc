#include "tools/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "tools/terminal.h"

namespace armcal {
namespace {

using Seconds = std::chrono::duration<double>;

// Of the process's terminal line.
std::atomic<bool> line_shown{false}, silent{false};

// A failure here is none of the run's.
void WriteError(const char* text, size_t size) {
  if (write(STDERR_FILENO, text, size) < 0) return;
}

bool IsWanted() {
  return IsTerminal(STDERR_FILENO) && std::getenv("CI") == nullptr;
}

}  // namespace

void EndProgress() {
  constexpr char kClear[] = "\r\x1b[K";
  silent = true;
  if (line_shown.exchange(false)) WriteError(kClear, sizeof(kClear) - 1);
}

std::string ClockText(double seconds) {
  const long s = std::lround(std::max(seconds, 0.0));
  char text[40];
  if (s < 3600) {
    std::snprintf(text, sizeof(text), "%ld:%02ld", s / 60, s % 60);
  } else {
    std::snprintf(text, sizeof(text), "%ld:%02ld:%02ld", s / 3600, s / 60 % 60,
                  s % 60);
  }
  return text;
}

ProgressBar::ProgressBar(const std::string& stage) : stage_(stage) {
  if (IsWanted()) drawing_ = std::thread(&ProgressBar::Draw, this);
}

ProgressBar::~ProgressBar() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  ended_.notify_all();
  if (drawing_.joinable()) drawing_.join();
  EndProgress();
}

void ProgressBar::Show(const std::string& stage, double fraction) {
  if (!drawing_.joinable()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  told_ = Clock::now();
  // A pass over the logs may come again under the same name.
  if (stage != stage_ || fraction < fraction_) stage_start_ = told_;
  stage_ = stage;
  fraction_ = std::min(fraction, 1.0);
}

std::function<void(const std::string&, double)> ProgressBar::Callback() {
  return [this](const std::string& stage, double fraction) {
    Show(stage, fraction);
  };
}

std::string ProgressBar::Line(Clock::time_point now) const {
  constexpr int kWidth = 20;
  char text[200];
  // A step that is done, and nothing is said of the next one.
  const bool done = fraction_ >= 1 && now - told_ > std::chrono::seconds(1);
  const std::string stage = done ? "after " + stage_ : stage_;
  std::snprintf(text, sizeof(text), "%-22.50s ", stage.c_str());
  std::string line = text;
  if (fraction_ >= 0 && !done) {
    const int filled = static_cast<int>(std::lround(kWidth * fraction_));
    std::snprintf(text, sizeof(text), "[%s%s] %3.0f %%  ",
                  std::string(filled, '#').c_str(),
                  std::string(kWidth - filled, '.').c_str(), 100 * fraction_);
    line += text;
  }
  line += ClockText(Seconds(now - start_).count());
  // As fast as so far; what is over at once needs no estimate.
  const double so_far = Seconds(told_ - stage_start_).count();
  if (fraction_ > 0 && fraction_ < 1 && so_far > .5) {
    const double left = so_far * (1 - fraction_) / fraction_;
    line += ", step ends in " + ClockText(left - Seconds(now - told_).count());
  }
  return line;
}

void ProgressBar::Draw() {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto over = [this] { return over_; };
  if (ended_.wait_for(lock, std::chrono::seconds(1), over)) return;
  do {
    if (silent) return;
    // One column stays free: a full line would wrap.
    const int width = TerminalWidth(STDERR_FILENO) - 1;
    const std::string line =
        "\r" + Line(Clock::now()).substr(0, width) + "\x1b[K";
    line_shown = true;
    WriteError(line.data(), line.size());
  } while (!ended_.wait_for(lock, std::chrono::milliseconds(500), over));
}

}  // namespace armcal
