#include "calib/logs/stamp_audit.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::stamp_audit_test {

Log Recorded(double duration, double step, bool with_velocity) {
  std::mt19937_64 random(3);
  Log log = RecordMotion(RandomMultisine(&random, 2), duration, step);
  if (!with_velocity) log.qd.resize(0, 0);
  return log;
}

// A logger that writes 2.5 rows a second, by its velocities and without.
TEST(StampAudit, ASlowLogIsInSeconds) {
  for (const bool with_velocity : {true, false}) {
    const StampFigures stamps = AuditStamps(Recorded(60, .4, with_velocity));
    EXPECT_EQ(stamps.unit, 1) << with_velocity;
    EXPECT_NEAR(stamps.step, .4, 1e-9);
  }
}

// The same steps as logged, of 2.5 kHz in ms.
TEST(StampAudit, AFastLogOfTheSameStepsIsInMilliseconds) {
  for (const bool with_velocity : {true, false}) {
    Log log = Recorded(5, 4e-4, with_velocity);
    log.t *= 1e3;
    const StampFigures stamps = AuditStamps(log);
    EXPECT_EQ(stamps.unit, 1e-3) << with_velocity;
    EXPECT_NEAR(stamps.step, 4e-4, 1e-12);
  }
}

// Positions and velocities in degrees move as fast in ms as others do in s.
TEST(StampAudit, VelocitiesTellWhateverThePositionsUnit) {
  Log log = Recorded(5, 4e-4, true);
  log.t *= 1e3;
  log.q *= 57.3;
  log.qd *= 57.3;
  EXPECT_EQ(AuditStamps(log).unit, 1e-3);
}

// Where no motion is known, what such steps most often are.
TEST(StampAudit, StepsAlone) {
  EXPECT_EQ(TimeUnitOf(.5), 1);
  EXPECT_EQ(TimeUnitOf(.97), 1e-3);  // of 1 kHz that jitters
  EXPECT_EQ(TimeUnitOf(10), 1e-3);
  EXPECT_EQ(TimeUnitOf(4000), 1e-6);
}

}  // namespace armcal::stamp_audit_test
