#include "calib/diagnose/select/reference.h"

#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/select/reference_noise.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::reference_test {

using testing::Contains;
using testing::Field;

class GapReferenceTest : public DiagnosedArm<32> {
 protected:
  // A log of what the arm was before, read and fitted.
  ReferenceModel Fit(double hz) {
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    LogSet logs({Record(before_, "reference.csv")}, reader, {});
    segments_ = ReadSegments(hz, {}, logs);
    BaselineOptions options;
    options.timing_s = .05;
    const GapBaseline file(File(), options, UsualTorque(segments_));
    return FitReference(file, hz, &segments_);
  }

  static constexpr double kQuadratic = .8;  // N m s^2/rad^2
  static constexpr double kLate = .018;     // s
  std::vector<GapSegment> segments_;
};

TEST_F(GapReferenceTest, KnowsWhatTheReferenceShows) {
  constexpr double kBandwidth = 6, kHalfRate = EffectPlant::kLogRate / 2;
  AddAlways("quadratic_friction", 1, {kQuadratic});
  const ReferenceModel model = Fit(kBandwidth);
  EXPECT_NEAR(model.delay, 0, .001);
  const std::vector<KnownEffect> known = model.baseline.known().At(
      Eigen::VectorXd::Ones(model.baseline.known().parameters().size()));
  ASSERT_EQ(known.size(), 1u);
  EXPECT_EQ(known[0].effect->name, "quadratic_friction");
  EXPECT_EQ(known[0].joint, 1);
  EXPECT_NEAR(known[0].p[0], kQuadratic, .1 * kQuadratic);
  // As large as what torques were given, of which the bandwidth leaves a part.
  const double white = kNoise * std::sqrt(kBandwidth / kHalfRate);
  const GapNoise noise = ReferenceNoise(model.baseline, kBandwidth, segments_);
  for (const Autoregression& joint : noise.joints) {
    EXPECT_NEAR(joint.stddev() / white, 1, .2);
  }
}

TEST_F(GapReferenceTest, KnowsHowLateTorqueIs) {
  AddAlways("delay", -1, {-kLate});
  EXPECT_NEAR(Fit(6).delay, kLate, .001);
}

TEST_F(GapReferenceTest, WhatItsLogShowedIsNoChange) {
  AddAlways("quadratic_friction", 1, {kQuadratic});
  AddAlways("delay", -1, {-kLate});
  std::vector<double> p(FindEffect("payload")->parameters.size(), 0);
  p[0] = .3;  // kg
  Add("payload", -1, p);
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "payload", -1);
  ExpectEstimate(diagnosis.effects[0], "mass", .3, .02);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_NEAR(diagnosis.corrected.delay, kLate, .001);
  ASSERT_FALSE(diagnosis.shown.empty());
  EXPECT_EQ(diagnosis.shown[0].effect->name, "quadratic_friction");
}

// A spring of which the diagnosed log has more, by a gain that makes it look
// so.
TEST_F(GapReferenceTest, WhatItShowsDoesNotDependOnTheOtherLog) {
  constexpr double kStiffness = 6;  // N m/rad
  AddAlways("spring", 1, {kStiffness, 0});
  Add("spring", 1, {.01, 0});
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ASSERT_FALSE(diagnosis.shown.empty());
  EXPECT_EQ(diagnosis.shown[0].effect->name, "spring");
  EXPECT_TRUE(diagnosis.effects.empty());
  EXPECT_NEAR(diagnosis.shown[0].estimates[0].value, kStiffness,
              2 * diagnosis.shown[0].stddev[0]);
  EXPECT_LT(diagnosis.shown[0].stddev[0], .001 * kStiffness);
}

// The reference carried a tool, which was taken off.
TEST_F(GapReferenceTest, WhatWasTakenOffHasANegativeMass) {
  std::vector<double> p(FindEffect("payload")->parameters.size(), 0);
  p[0] = .3;  // kg
  AddAlways("payload", -1, p);
  p[0] = -.3;
  Add("payload", -1, p);
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "payload", -1);
  ExpectEstimate(diagnosis.effects[0], "mass", -.3, .02);
  EXPECT_EQ(diagnosis.effects.size(), 1u);
}

// Friction is never the same on another day: that is said, and is no effect.
TEST_F(GapReferenceTest, FrictionOfTheDayIsSaidNotBlamed) {
  const double change = .08;  // of 1.5 N m
  Add("coulomb_friction", 0, {change});
  Add("coulomb_friction", 1, {-change});
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  EXPECT_TRUE(diagnosis.effects.empty());
  for (const int j : {0, 1}) {
    const std::string name = File().links[j].joint.name + ".coulomb";
    ASSERT_THAT(diagnosis.moved, Contains(Field(&MovedParameter::name, name)));
    for (const MovedParameter& moved : diagnosis.moved) {
      if (moved.name != name) continue;
      EXPECT_NEAR(moved.value - moved.nominal, j == 0 ? change : -change,
                  .2 * change + 3 * moved.stddev);
    }
  }
}

// Bristles of .8 N m and friction of 1.5 N m beside them, both of which fall by
// a quarter: the file has their sum.
TEST_F(GapReferenceTest, FrictionOfTheDayIsAShareOfItsLawsToo) {
  constexpr double kBristles = .8, kCoulomb = 1.5, kShort = .004;  // N m, rad
  for (const int j : {0, 1}) {
    AddAlways("presliding", j, {kBristles, kShort});
    Add("presliding", j, {-.25 * kBristles, kShort});
    Add("coulomb_friction", j, {-.25 * kCoulomb});
  }
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  for (const FoundEffect& found : diagnosis.effects) {
    EXPECT_TRUE(found.of_another_day) << found.effect->name;
  }
  for (const int j : {0, 1}) {
    const std::string name = File().links[j].joint.name + ".coulomb";
    ASSERT_THAT(diagnosis.moved, Contains(Field(&MovedParameter::name, name)));
    for (const MovedParameter& moved : diagnosis.moved) {
      if (moved.name != name) continue;
      EXPECT_NEAR(moved.nominal, kCoulomb + kBristles, .2);
      EXPECT_NEAR(moved.value / moved.nominal, .75, .05);
    }
  }
  ASSERT_FALSE(diagnosis.shown.empty());
  for (const ShownEffect& shown : diagnosis.shown) {
    EXPECT_EQ(shown.effect->name, "presliding");
    EXPECT_LT(shown.stddev[0], .1 * kBristles);
  }
}

// The day is the same for all joints.
TEST_F(GapReferenceTest, FrictionOfOneJointIsAChange) {
  Add("coulomb_friction", 1, {.12});  // of 1.5 N m
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].effect->name, "coulomb_friction");
  EXPECT_EQ(diagnosis.effects[0].joint, 1);
  ExpectEstimate(diagnosis.effects[0], "coulomb", .12, .2);
}

// A brake that drags is more than a day.
TEST_F(GapReferenceTest, MoreThanADayIsAnEffect) {
  Add("coulomb_friction", 1, {.9});
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ExpectFirst(diagnosis, "coulomb_friction", 1);
  ExpectEstimate(diagnosis.effects[0], "coulomb", .9, .1);
}

}  // namespace armcal::reference_test
