#include "calib/diagnose/data/rows.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal {
bool operator==(const GapRows::Run& a, const GapRows::Run& b) {
  return a.segment == b.segment && a.begin == b.begin && a.size == b.size;
}
void PrintTo(const GapRows::Run& run, std::ostream* out) {
  *out << run.segment << ": " << run.begin << " + " << run.size;
}
}  // namespace armcal

namespace armcal::rows_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::IsEmpty;
using Stretch = GapRows::Run;

// 250 Hz at a bandwidth of 6 Hz: every floor(250 / 15) = 16th sample, 0.064 s
// apart, without ceil(4 / 6 s 250 Hz) = 167 samples at each end.
constexpr double kStep = .004, kBandwidth = 6;

GapSegment Segment(int size, int num_joints = 1, double t0 = 0) {
  GapSegment segment;
  segment.motion.t0 = t0;
  segment.motion.dt = kStep;
  segment.motion.q.setZero(size, num_joints);
  segment.tau.setZero(size, num_joints);
  segment.still.setConstant(size, num_joints, false);
  return segment;
}

std::vector<Autoregression> White(const std::vector<double>& sigma) {
  std::vector<Autoregression> noise(sigma.size());
  for (size_t j = 0; j < sigma.size(); ++j) noise[j].sigma = sigma[j];
  return noise;
}

TEST(GapRows, ThinTheirSegments) {
  const std::vector<GapSegment> segments = {Segment(5000, 2, 3),
                                            Segment(1000, 2, 50)};
  const GapRows rows(segments, kBandwidth);
  EXPECT_NEAR(rows.step(0), .064, 1e-12);
  // (4999 - 334) / 16 + 1 and (999 - 334) / 16 + 1.
  EXPECT_EQ(rows.thin_begin(1), 292);
  EXPECT_EQ(rows.num_thin(), 292 + 42);
  EXPECT_NEAR(rows.thin_time(0, 0), 3 + 167 * kStep, 1e-9);
  EXPECT_NEAR(rows.thin_time(0, 10), 3 + (167 + 160) * kStep, 1e-9);
  EXPECT_NEAR(rows.thin_time(1, 292), 50 + 167 * kStep, 1e-9);
  const MatrixXd index = VectorXd::LinSpaced(1000, 0, 999);
  const MatrixXd picked = rows.Pick(1, index);
  ASSERT_EQ(picked.rows(), 42);
  EXPECT_EQ(picked(0, 0), 167);
  EXPECT_EQ(picked(41, 0), 167 + 41 * 16);
  // No run goes from one segment to the next.
  EXPECT_THAT(rows.runs(1),
              ElementsAre(Stretch{0, 0, 292}, Stretch{1, 292, 42}));
  EXPECT_EQ(rows.num_rows(1), 292 + 42 - 8);
  EXPECT_EQ(rows.num_rows(), 2 * (292 + 42 - 8));
}

// The low pass has the gain 1 / (1 + (f / bandwidth)^8).
TEST(GapRows, LowPassWhatTheyThin) {
  const std::vector<GapSegment> segments = {Segment(5000)};
  const GapRows rows(segments, kBandwidth);
  for (const double hz : {2., 6., 12.}) {
    const VectorXd t = VectorXd::LinSpaced(5000, 0, 4999 * kStep);
    const MatrixXd sine = (2 * M_PI * hz * t.array()).sin();
    const double gain = 1 / (1 + std::pow(hz / kBandwidth, 8));
    const MatrixXd thin = rows.Thin(0, sine), picked = rows.Pick(0, sine);
    EXPECT_LT((thin - gain * picked).norm(), .01 * picked.norm()) << hz;
  }
}

TEST(GapRows, AJointThatStandsHasNone) {
  std::vector<GapSegment> segments = {Segment(5000, 2)};
  // Thinned samples 100 to 149 and, too short for a run, 160 to 169.
  segments[0].still.col(1).segment(167 + 1600, 50 * 16 - 1).setConstant(true);
  segments[0].still.col(1).segment(167 + 2560, 10 * 16 - 1).setConstant(true);
  const GapRows rows(segments, kBandwidth);
  EXPECT_THAT(rows.runs(0), ElementsAre(Stretch{0, 0, 292}));
  EXPECT_THAT(rows.still_runs(0), IsEmpty());
  // Between 150 and 159 it moves for less than three orders of the noise.
  EXPECT_THAT(rows.runs(1),
              ElementsAre(Stretch{0, 0, 100}, Stretch{0, 170, 122}));
  EXPECT_THAT(rows.still_runs(1), ElementsAre(Stretch{0, 100, 50}));
}

// Tenths of 29.2 thinned samples; guards of half of 4 / 6 s = 5.2 samples.
TEST(GapRows, TheLastFoldHasTheThirdSixthAndNinthTenth) {
  const std::vector<GapSegment> segments = {Segment(5000)};
  const GapRows fitted(segments, kBandwidth, LogPart::OtherFolds(2));
  const GapRows held_out(segments, kBandwidth, LogPart::Fold(2));
  EXPECT_THAT(fitted.runs(0),
              ElementsAre(Stretch{0, 0, 59}, Stretch{0, 88, 58},
                          Stretch{0, 176, 58}, Stretch{0, 263, 29}));
  EXPECT_THAT(held_out.runs(0),
              ElementsAre(Stretch{0, 64, 19}, Stretch{0, 152, 18},
                          Stretch{0, 239, 19}));
}

// Of four blocks of 34 thinned samples the first fold has two; what is
// predicted at all is every block within its guards.
TEST(GapRows, FoldsTakeBlocksByTurns) {
  const std::vector<GapSegment> segments = {Segment(2500)};
  const auto runs = [&](LogPart part) {
    return GapRows(segments, kBandwidth, part).runs(0);
  };
  const std::vector<GapRows::Run> every = runs(LogPart::AnyFold());
  ASSERT_EQ(every.size(), 4u);
  std::vector<GapRows::Run> of_folds;
  for (int fold = 0; fold < LogPart::kFolds; ++fold) {
    for (const GapRows::Run& run : runs(LogPart::Fold(fold))) {
      of_folds.push_back(run);
    }
  }
  EXPECT_THAT(of_folds, ElementsAre(every[0], every[3], every[1], every[2]));
  EXPECT_THAT(runs(LogPart::OtherFolds(1)),
              ElementsAre(Stretch{0, 0, 34}, Stretch{0, 68, 68}));
}

// Blocks of a shorter segment are as long as guards (10.4 thinned samples) and
// the shortest run (12) are at least; a third of them is in a fold.
TEST(GapRows, AFoldHasEachThirdBlockOfAShortSegment) {
  const auto held_out = [](double seconds) {
    const std::vector<GapSegment> segments = {
        Segment(static_cast<int>(seconds / kStep))};
    return GapRows(segments, kBandwidth, LogPart::Fold(2)).runs(0).size();
  };
  EXPECT_EQ(held_out(16.2), 3u);  // tenths
  EXPECT_EQ(held_out(15.2), 2u);  // sevenths
  EXPECT_EQ(held_out(8), 1u);     // fourths
  const double shortest = GapRows::ShortestSplit(kBandwidth);
  EXPECT_NEAR(shortest, 34.4 / 6, 1e-9);
  EXPECT_EQ(held_out(shortest + .2), 1u);
  EXPECT_EQ(held_out(shortest - .2), 0u);
  // Too short: always fitted, never predicted.
  const std::vector<GapSegment> segments = {Segment(1250)};
  EXPECT_THAT(GapRows(segments, kBandwidth, LogPart::OtherFolds(0)).runs(0),
              ElementsAre(Stretch{0, 0, 58}));
  EXPECT_THAT(GapRows(segments, kBandwidth, LogPart::AnyFold()).runs(0),
              IsEmpty());
}

TEST(GapRows, PartsOfStillJointsAreSplitAsWell) {
  std::vector<GapSegment> segments = {Segment(5000)};
  segments[0].still.setConstant(true);
  const GapRows held_out(segments, kBandwidth, LogPart::Fold(2));
  EXPECT_THAT(held_out.runs(0), IsEmpty());
  EXPECT_THAT(held_out.still_runs(0),
              ElementsAre(Stretch{0, 64, 19}, Stretch{0, 152, 18},
                          Stretch{0, 239, 19}));
}

// Noise made of known innovations gives these back, run by run.
TEST(GapRows, WhitenTheirNoise) {
  std::vector<GapSegment> segments = {Segment(5000, 2)};
  segments[0].still.col(1).segment(167 + 1600, 50 * 16 - 1).setConstant(true);
  GapRows rows(segments, kBandwidth);
  std::vector<Autoregression> noise = White({.5, 2});
  noise[1].a << .7, -.3, .2, .1;
  rows.SetNoise(noise, MatrixXd::Zero(292, 2));
  std::mt19937_64 random(1);
  MatrixXd e = MatrixXd::Zero(292, 1), x = e;
  AddNoise(&random, VectorXd::Constant(1, 2), &e);
  for (int k = 0; k < 292; ++k) {
    x(k, 0) = e(k, 0);
    for (int i = 1; i <= std::min(k, 4); ++i) {
      x(k, 0) += noise[1].a[i - 1] * x(k - i, 0);
    }
  }
  const MatrixXd white = rows.Whiten(1, x);
  const std::vector<int> samples = rows.SampleOfRow(1);
  ASSERT_EQ(white.rows(), rows.num_rows(1));
  ASSERT_EQ(samples.size(), 96u + 138u);
  EXPECT_EQ(samples[0], 4);
  EXPECT_EQ(samples[96], 154);
  for (size_t k = 0; k < samples.size(); ++k) {
    EXPECT_NEAR(white(k, 0), e(samples[k], 0) / 2, 1e-9);
  }
  EXPECT_NEAR(rows.Whiten(0, x)(0, 0), x(4, 0) / .5, 1e-9);
}

// A sample of variance sigma^2 + extra_stddev^2 counts as one.
TEST(GapRows, SamplesOfExtraVarianceCountLess) {
  const std::vector<GapSegment> segments = {Segment(5000)};
  GapRows rows(segments, kBandwidth);
  MatrixXd extra_stddev = MatrixXd::Zero(292, 1);
  extra_stddev(10, 0) = 4;
  rows.SetNoise(White({3}), extra_stddev);
  const MatrixXd white = rows.Whiten(0, MatrixXd::Constant(292, 1, 1));
  EXPECT_NEAR(rows.variance(0, 9), 9, 1e-9);
  EXPECT_NEAR(rows.variance(0, 10), 25, 1e-9);
  EXPECT_NEAR(white(9 - 4, 0), 1. / 3, 1e-9);
  EXPECT_NEAR(white(10 - 4, 0), 1. / 5, 1e-9);
}

// Of reconstructed torques the level is not known, and the rest to no better
// than a thousandth.
TEST(GapRows, GiveReconstructedTorquesExtraVariance) {
  std::vector<GapSegment> segments = {Segment(5000), Segment(5000)};
  segments[0].reconstructed_torque = segments[0].torque_drifts = true;
  for (GapSegment& segment : segments) segment.tau.setConstant(8);
  GapRows rows(segments, kBandwidth);
  const MatrixXd level = MatrixXd::Constant(584, 1, 7);
  const MatrixXd without = rows.WithoutDrift(0, level);
  EXPECT_LT(without.topRows(292).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(without.bottomRows(292), level.bottomRows(292));
  rows.SetNoise(White({.03}), MatrixXd::Zero(584, 1));
  EXPECT_NEAR(rows.variance(0, 0), .03 * .03 + .001 * .001 * 64 / 2, 1e-12);
  EXPECT_LT(rows.Whiten(0, level).topRows(288).cwiseAbs().maxCoeff(), 1e-6);
  MatrixXd unknown = level;
  unknown.topRows(50).setConstant(std::nan(""));
  EXPECT_LT(rows.WithoutDrift(0, unknown).middleRows(50, 242).norm(), 1e-6);
}

TEST(GapRows, OfALogTooShortAreNone) {
  const std::vector<GapSegment> segments = {Segment(300)};
  const GapRows rows(segments, kBandwidth);
  EXPECT_EQ(rows.num_thin(), 0);
  EXPECT_EQ(rows.num_rows(), 0);
}

}  // namespace armcal::rows_test
