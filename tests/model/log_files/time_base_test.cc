#include "model/log_files/time_base.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::time_base_test {

using testing::HasSubstr;

using Motion = std::function<double(double)>;
constexpr TimeRange kAll;

// A log with one joint at rest, times as text.
TimeBase Audit(const std::vector<std::string>& times,
               const TimeRange& crop = kAll,
               const std::vector<Motion>& motion = {}) {
  const size_t n = std::max<size_t>(1, motion.size());
  std::string text = "t";
  LogReaderOptions options;
  options.need_torque = false;
  for (size_t j = 1; j <= n; ++j) {
    text += ",q" + std::to_string(j);
    options.joint_names.push_back("j" + std::to_string(j));
  }
  for (const std::string& t : times) {
    text += "\n" + t;
    for (size_t j = 0; j < n; ++j) {
      const double q = motion.empty() ? 0 : motion[j](std::stod(t));
      text += "," + std::to_string(q);
    }
  }
  const std::string path = WriteFile(text + "\n");
  KeptLog log(path, options);
  const TimeBase base = AuditTimeBase(crop, &log);
  EXPECT_EQ(log.Next()->first_row, 2);  // the audit leaves it rewound
  return base;
}

std::string Decimal(double t, int decimals) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.*f", decimals, t);
  return text;
}

std::vector<std::string> Uniform(int n, double dt, int decimals,
                                 const std::string& before = "") {
  std::vector<std::string> times;
  for (int k = 0; k < n; ++k)
    times.push_back(before + Decimal(k * dt, decimals));
  return times;
}

TEST(AuditTimeBase, KnowsUniformDecimalStamps) {
  for (const double dt : {.0001, .001, .002, .01, .1}) {
    const TimeBase base = Audit(Uniform(5000, dt, 4));
    EXPECT_TRUE(base.uniform) << dt;
    EXPECT_EQ(base.samples, 5000);
    EXPECT_NEAR(base.dt, dt, 1e-12);
    EXPECT_NEAR(base.median_step, dt, 1e-9);
    EXPECT_NEAR(base.range.end, 4999 * dt, 1e-9);
    EXPECT_EQ(base.range.begin, 0);
    EXPECT_TRUE(base.gaps.empty());
    EXPECT_EQ(base.duplicates, 0);
    EXPECT_EQ(base.motion_hz, 0);
  }
  // Epoch stamps: 1700000000.000, ... (0.x -> 1700000000.x).
  const TimeBase epoch = Audit(Uniform(900, .001, 3, "170000000"));
  EXPECT_TRUE(epoch.uniform);
  EXPECT_NEAR(epoch.dt, .001, 1e-12);
}

TEST(AuditTimeBase, StampsRoundedToMuchOfAStepAreNotUniform) {
  const TimeBase base = Audit(Uniform(3000, 1 / 93.6, 3));  // 10 or 11 ms
  EXPECT_FALSE(base.uniform);
  EXPECT_NEAR(base.dt, 1 / 93.6, 1e-6);
  EXPECT_NEAR(base.min_step, .010, 1e-12);
  EXPECT_NEAR(base.max_step, .011, 1e-12);
  EXPECT_THAT(base.Describe(), HasSubstr("3000 samples in 32.04 s, 93.6 Hz, "
                                         "steps 10-11 ms (resampled)"));
}

TEST(AuditTimeBase, MeasuresJitter) {
  std::vector<std::string> times;
  double t = 0;
  for (int k = 0; k < 2001; ++k) {
    times.push_back(Decimal(t, 6));
    t += k % 2 == 0 ? .0018 : .0022;
  }
  const TimeBase base = Audit(times);
  EXPECT_FALSE(base.uniform);
  EXPECT_NEAR(base.dt, .002, 1e-9);
  EXPECT_NEAR(base.min_step, .0018, 1e-12);
  EXPECT_NEAR(base.max_step, .0022, 1e-12);
  EXPECT_TRUE(base.gaps.empty());
}

// Samples taken evenly, some of the first ones lost, by a clock that sways by
// 20 ms.
TEST(AuditTimeBase, KnowsHowUnevenStampsAre) {
  const auto sway = [](double t) { return .02 * std::sin(2 * M_PI * t / 15); };
  std::vector<std::string> times;
  for (int k = 0; k < 11250; ++k) {
    const double t = .004 * k;
    if (k % 50 != 17 || k > 4000)
      times.push_back(Decimal(1.03 * t + sway(t), 6));
  }
  const TimeBase base = Audit(times);
  ASSERT_NEAR(base.stamp_errors.size(), 45, 2);
  // Beside a line: three whole periods have a slope of -9 / (2 pi)^2 their
  // size over the log, for both halves.
  for (const StampError& error : base.stamp_errors) {
    const double t = (error.stamp - sway(error.stamp / 1.03)) / 1.03;
    const double line = -.02 * 12 / (2 * M_PI * 3) * ((t - 22.5) / 45);
    EXPECT_NEAR(error.error, sway(t) - line, 5e-4) << t;
  }
  EXPECT_TRUE(Audit(Uniform(500, .004, 3)).stamp_errors.empty());
  std::vector<std::string> lost = Uniform(11250, .004, 6);
  for (int k = 11000; k > 0; k -= 300) lost.erase(lost.begin() + k);
  EXPECT_TRUE(Audit(lost).stamp_errors.empty());
}

TEST(AuditTimeBase, KeepsGapsOutOfTheStep) {
  std::vector<std::string> times;
  for (int k = 0; k < 1000; ++k) {
    if (k >= 300 && k < 302) continue;  // 3 steps: not yet a gap
    if (k >= 500 && k < 524) continue;  // 0.25 s
    if (k >= 800 && k < 803) continue;  // 4 steps
    times.push_back(Decimal(.01 * k, 2));
  }
  const TimeBase base = Audit(times);
  EXPECT_FALSE(base.uniform);
  EXPECT_NEAR(base.median_step, .01, 1e-12);
  EXPECT_NEAR(base.dt, .01, 5e-5);
  EXPECT_NEAR(base.max_step, .25, 1e-12);
  ASSERT_EQ(base.gaps.size(), 2);
  EXPECT_NEAR(base.gaps[0].begin, 4.99, 1e-12);
  EXPECT_NEAR(base.gaps[0].end, 5.24, 1e-12);
  EXPECT_NEAR(base.gaps[1].begin, 7.99, 1e-12);
  EXPECT_NEAR(base.gaps[1].end, 8.03, 1e-12);
  EXPECT_THAT(base.Describe(), HasSubstr("2 gaps over 3 steps"));
}

TEST(AuditTimeBase, DropsDuplicates) {
  const TimeBase base =
      Audit({"0", "0.1", "0.1", "0.1", "0.2", "0.3", "0.3", "0.4"});
  EXPECT_EQ(base.samples, 5);
  EXPECT_EQ(base.duplicates, 3);
  EXPECT_TRUE(base.uniform);
  EXPECT_NEAR(base.dt, .1, 1e-12);
  EXPECT_EQ(base.Describe(),
            "5 samples in 0.4 s, 10 Hz, 3 duplicate times dropped");
}

TEST(AuditTimeBase, LooksAtTheCropOnly) {
  auto times = Uniform(100, .1, 1);
  times[90] = "9.05", times[3] = "0.2";  // outside
  const TimeBase base = Audit(times, {1, 4.0});
  EXPECT_EQ(base.samples, 31);  // both ends belong to it
  EXPECT_EQ(base.duplicates, 0);
  EXPECT_TRUE(base.uniform);
  EXPECT_NEAR(base.range.begin, 1, 1e-12);
  EXPECT_NEAR(base.range.end, 4, 1e-12);
}

// Times are those since the log's first row.
TEST(AuditTimeBase, CropCountsFromTheFirstRow) {
  const TimeBase base = Audit({"100", "101", "102", "103", "104"}, {1, 3});
  EXPECT_EQ(base.samples, 3);
  EXPECT_EQ(base.range.begin, 1);
}

TEST(AuditTimeBase, RefusesFewerThanThreeSamples) {
  const auto message = [](const std::vector<std::string>& times,
                          const TimeRange& crop) {
    return MessageOf<InputError>("", [&] { Audit(times, crop); });
  };
  EXPECT_THAT(message({"0", "1"}, kAll), HasSubstr("found '2 samples'"));
  EXPECT_THAT(message({"0", "1", "1", "1"}, kAll), HasSubstr("'2 samples'"));
  EXPECT_THAT(message(Uniform(100, .1, 1), {20, 30}),
              HasSubstr("found '0 samples': expected at least 3 samples"));
}

// rms velocity over rms position of a sine of f Hz is 2 pi f.
TEST(AuditTimeBase, FindsTheFrequencyOfTheMotion) {
  const auto sine = [](double amplitude, double f) {
    return
        [=](double t) { return 1 + amplitude * std::sin(6.2831853 * f * t); };
  };
  const auto frequency = [](const std::vector<Motion>& motion, double dt) {
    return Audit(Uniform(static_cast<int>(10 / dt), dt, 3), kAll, motion)
        .motion_hz;
  };
  EXPECT_NEAR(frequency({sine(.5, 2)}, .001), 2, .02);
  EXPECT_NEAR(frequency({sine(.5, 2)}, .01), 2, .02);
  EXPECT_NEAR(frequency({sine(2, .3)}, .004), .3, .003);
  // The fastest joint counts, unless it moves by less than 1 mrad.
  EXPECT_NEAR(frequency({sine(2, .3), sine(.01, 4), sine(.0005, 9)}, .002), 4,
              .1);
  // A coarse encoder (1 mrad, at 1 kHz) does not look like fast motion.
  const auto coarse = [&](double t) {
    return 1e-3 * std::round(1e3 * sine(.05, 1)(t));
  };
  EXPECT_NEAR(frequency({coarse}, .001), 1, .02);
}

TEST(AuditTimeBase, RealLog) {
  const std::string path = SHARED_DIR "/data/panda/log.csv";
  if (!std::ifstream(path)) GTEST_SKIP() << path << " is absent";
  LogReaderOptions options;
  for (int j = 1; j <= 7; ++j) {
    options.joint_names.push_back("panda_joint" + std::to_string(j));
  }
  KeptLog log(path, options);
  const TimeBase base = AuditTimeBase(kAll, &log);
  EXPECT_GT(base.samples, 1000);
  EXPECT_NEAR(base.dt * static_cast<double>(base.samples - 1),
              base.range.end - base.range.begin, .2 * base.range.end);
}

}  // namespace armcal::time_base_test
