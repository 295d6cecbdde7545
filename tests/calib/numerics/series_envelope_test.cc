#include "calib/numerics/series_envelope.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::series_envelope_test {

using Eigen::Vector2d;

TEST(SeriesEnvelope, FewSamplesAreThemselves) {
  SeriesEnvelope envelope(2, 10);
  for (int k = 0; k < 10; ++k) envelope.Add(k, Vector2d(k, -k));
  ASSERT_EQ(envelope.bins().size(), 10u);
  for (int k = 0; k < 10; ++k) {
    const SeriesEnvelope::Bin& bin = envelope.bins()[k];
    EXPECT_EQ(bin.begin, k);
    EXPECT_EQ(bin.end, k);
    EXPECT_EQ(bin.low, Vector2d(k, -k));
    EXPECT_EQ(bin.high, Vector2d(k, -k));
    EXPECT_EQ(bin.follows, k > 0);
  }
}

// However many there are: a spike of one sample is in exactly one bin, at its
// time, and every sample is counted.
TEST(SeriesEnvelope, NoSpikeIsLost) {
  constexpr int kSamples = 100'003, kSpike = 70'001;
  SeriesEnvelope envelope(1, 100);
  for (int k = 0; k < kSamples; ++k) {
    envelope.Add(.001 * k, Eigen::VectorXd::Constant(
                               1, k == kSpike ? 1e3 : std::sin(.01 * k)));
  }
  EXPECT_LE(envelope.bins().size(), 100u);
  EXPECT_GT(envelope.bins().size(), 40u);
  long samples = 0;
  int spikes = 0;
  for (const SeriesEnvelope::Bin& bin : envelope.bins()) {
    samples += bin.samples;
    EXPECT_LE(bin.low[0], bin.high[0]);
    if (bin.high[0] < 2) continue;
    ++spikes;
    EXPECT_LE(bin.begin, .001 * kSpike);
    EXPECT_GE(bin.end, .001 * kSpike);
  }
  EXPECT_EQ(spikes, 1);
  EXPECT_EQ(samples, kSamples);
}

TEST(SeriesEnvelope, AGapBeginsABin) {
  SeriesEnvelope envelope(1, 8);
  for (int k = 0; k < 12; ++k) {
    if (k == 10) envelope.Break();
    envelope.Add(k, Eigen::VectorXd::Ones(1));
  }
  int gaps = 0;
  for (const SeriesEnvelope::Bin& bin : envelope.bins()) {
    if (bin.follows) continue;
    ++gaps;
    EXPECT_TRUE(bin.begin == 0 || bin.begin == 10) << bin.begin;
  }
  EXPECT_EQ(gaps, 2);
}

// No bin reaches across one, however often bins are joined afterwards; but
// where nearly every sample has one, memory stays bounded.
TEST(SeriesEnvelope, GapsOutliveManySamples) {
  SeriesEnvelope few(1, 20), many(1, 20);
  for (int k = 0; k < 1000; ++k) {
    const double t = k + (k >= 333 ? 100 : 0);
    if (k == 333) few.Break();
    many.Break();
    few.Add(t, Eigen::VectorXd::Ones(1));
    many.Add(t, Eigen::VectorXd::Ones(1));
  }
  EXPECT_LE(few.bins().size(), 20u);
  for (const SeriesEnvelope::Bin& bin : few.bins()) {
    EXPECT_TRUE(bin.end < 333 || bin.begin >= 433) << bin.begin;
  }
  EXPECT_LE(many.bins().size(), 20u);
}

}  // namespace armcal::series_envelope_test
