#include "calib/diagnose/select/events.h"

#include <gtest/gtest.h>

namespace armcal::events_test {

// A pulse on a joint, seen for .4 s to both sides of its time.
GapEvent PulseAt(int joint, double time, double deviations) {
  GapEvent event;
  event.pulse = true;
  event.contact.joint = joint;
  event.contact.time = time;
  event.contact.window = {time - .4, time + .4};
  event.contact.deviations = deviations;
  event.delta_chi2 = event.score = deviations * deviations;
  return event;
}

// What one push leaves beside the pulse that fits it best is no other push.
TEST(EventsTest, PulsesThatOverlapOnAJointAreOnePush) {
  const std::vector<GapEvent> joined =
      JoinedPulses({PulseAt(1, 5.5, 4), PulseAt(1, 4.5, 5), PulseAt(1, 5, 20)});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_DOUBLE_EQ(joined[0].contact.time, 5);
  EXPECT_DOUBLE_EQ(joined[0].contact.window.begin, 4.1);
  EXPECT_DOUBLE_EQ(joined[0].contact.window.end, 5.9);
  EXPECT_DOUBLE_EQ(joined[0].contact.deviations, 20);
  EXPECT_DOUBLE_EQ(joined[0].delta_chi2, 16 + 25 + 400);
}

TEST(EventsTest, PulsesApartOrOnOtherJointsAreSeveral) {
  EXPECT_EQ(JoinedPulses({PulseAt(1, 5, 4), PulseAt(1, 6, 4)}).size(), 2u);
  EXPECT_EQ(JoinedPulses({PulseAt(1, 5, 4), PulseAt(2, 5.1, 4)}).size(), 2u);
  GapEvent elsewhere = PulseAt(1, 5.1, 4);
  elsewhere.contact.log = 1;
  EXPECT_EQ(JoinedPulses({PulseAt(1, 5, 4), elsewhere}).size(), 2u);
}

// A force that was fitted has a course of its own.
TEST(EventsTest, OnlyPulsesAreJoined) {
  GapEvent touch = PulseAt(1, 5.1, 4);
  touch.pulse = false;
  const std::vector<GapEvent> joined =
      JoinedPulses({PulseAt(1, 5.2, 4), touch});
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_FALSE(joined[0].pulse);
}

TEST(EventsTest, AConfirmedTouchIsToldByItsPulse) {
  GapEvent touch = PulseAt(1, 5, 2);
  EXPECT_DOUBLE_EQ(ToldContact(touch).deviations, 2);
  touch.as_pulse = PulseAt(2, 5.3, 9).contact;
  EXPECT_DOUBLE_EQ(ToldContact(touch).deviations, 9);
}

}  // namespace armcal::events_test
