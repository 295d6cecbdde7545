#include "calib/diagnose/select/contact_events.h"

#include <gtest/gtest.h>

namespace armcal::contact_events_test {

// A Coulomb friction that changed stands out from what friction did before for
// as long as the arm moves.
TEST(LastsTooLong, WhereOneTouchFillsAThirdOfTheLogs) {
  Contact contact;
  contact.window = {3, 12};
  EXPECT_FALSE(LastsTooLong(30, contact));
  contact.window.end = 14;
  EXPECT_TRUE(LastsTooLong(30, contact));
}

}  // namespace armcal::contact_events_test
