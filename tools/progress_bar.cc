#include "tools/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace armcal {

ProgressBar::ProgressBar() : start_(Clock::now()) {
  const char* term = std::getenv("TERM");
  wanted_ = isatty(STDERR_FILENO) != 0 && std::getenv("CI") == nullptr &&
            term != nullptr && std::strcmp(term, "dumb") != 0;
}

ProgressBar::~ProgressBar() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::Show(const std::string& stage, double fraction) {
  const Clock::time_point now = Clock::now();
  if (!wanted_ || now - start_ < std::chrono::seconds(1)) return;
  if (shown_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  shown_ = true;
  constexpr int kWidth = 30;
  const int done =
      static_cast<int>(kWidth * std::clamp(fraction, 0.0, 1.0) + 0.5);
  std::fprintf(stderr, "\r%-16s [%s%s] %3.0f %%\x1b[K", stage.c_str(),
               std::string(done, '#').c_str(),
               std::string(kWidth - done, '.').c_str(), 100 * fraction);
  std::fflush(stderr);
}

}  // namespace armcal
