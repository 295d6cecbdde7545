#include "model/text/calendar_time.h"

#include <cmath>
#include <ctime>

namespace armcal {
namespace {

std::string Written(std::time_t time, const char* format) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[40];
  return std::string(text, std::strftime(text, sizeof(text), format, &parts));
}

}  // namespace

std::optional<double> ParseCalendarTime(const std::string& text) {
  for (const char* format : {"%Y-%m-%d", "%Y-%m-%dT%H:%M", "%FT%H:%M:%S"}) {
    std::tm parts{};
    const char* end = strptime(text.c_str(), format, &parts);
    if (end == nullptr || *end != '\0') continue;
    const std::time_t time = timegm(&parts);
    // 31 February is none.
    if (Written(time, format) == text) return static_cast<double>(time);
  }
  return std::nullopt;
}

std::string CalendarText(double time) {
  const auto whole = static_cast<std::time_t>(std::llround(time));
  return Written(whole, whole % 86400 == 0 ? "%F" : "%FT%H:%M:%S");
}

}  // namespace armcal
