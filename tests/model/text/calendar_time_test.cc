#include "model/text/calendar_time.h"

#include <gtest/gtest.h>

namespace armcal::calendar_time_test {

// Seconds by `date -u -d TEXT +%s`.
TEST(CalendarTime, IsUnixTime) {
  EXPECT_EQ(ParseCalendarTime("1970-01-01"), 0);
  EXPECT_EQ(ParseCalendarTime("2026-11-21"), 1795219200);
  EXPECT_EQ(ParseCalendarTime("2026-11-21T16:11"), 1795277460);
  EXPECT_EQ(ParseCalendarTime("2026-11-21T16:11:41"), 1795277501);
  EXPECT_EQ(CalendarText(1795219200), "2026-11-21");
  EXPECT_EQ(CalendarText(1795277501.3), "2026-11-21T16:11:41");
}

TEST(CalendarTime, RefusesWhatIsNone) {
  for (const char* text : {"", "today", "2026-02-31", "2026-13-01", "26-1-1",
                           "2026-11-21 ", "2026-11-21T25:00", "2026-11-21x"}) {
    EXPECT_FALSE(ParseCalendarTime(text)) << text;
  }
}

}  // namespace armcal::calendar_time_test
