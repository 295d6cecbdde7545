#pragma once

#include <optional>
#include <string>

namespace armcal {

// "2026-11-21", "2026-11-21T10:30" or "2026-11-21T10:30:05", UTC, as seconds
// since 1970; nothing where the text is none of these.
std::optional<double> ParseCalendarTime(const std::string& text);
// The other way, to whole seconds; the date alone at midnight.
std::string CalendarText(double time);

}  // namespace armcal
