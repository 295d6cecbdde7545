#include "model/simd/kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace armcal::simd {
namespace {

// Against the library's functions, which are right to half a unit in the last
// place; near multiples of pi / 2 the smaller of the two is, too.
TEST(Kernels, SinesAndCosinesAreTheLibrarys) {
  std::mt19937 random(1);
  std::vector<double> angles = {0, -0., 1e-300, 1e5, -1e5, 3e5, 1e18, M_PI};
  for (const double range : {1., 10., 1e3, 1e5, 1e7}) {
    std::uniform_real_distribution<double> angle(-range, range);
    for (int k = 0; k < 10007; ++k) angles.push_back(angle(random));
  }
  for (int k = -2000; k < 2000; ++k) angles.push_back(k * M_PI_2);
  const long count = static_cast<long>(angles.size());
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    std::vector<double> sine(count), cosine(count);
    kernels->sine_cosine(angles.data(), count, sine.data(), cosine.data());
    double worst = 0;
    for (long k = 0; k < count; ++k) {
      const double of_sine = sine[k] - std::sin(angles[k]);
      const double of_cosine = cosine[k] - std::cos(angles[k]);
      worst = std::max({worst, std::abs(of_sine), std::abs(of_cosine)});
    }
    EXPECT_LE(worst, std::numeric_limits<double>::epsilon());
  }
}

// Its bits are an angle's own: neither its place nor its neighbours, however
// large, make a difference.
TEST(Kernels, SinesDoNotDependOnTheirNeighbours) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-4, 4);
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    for (int k = 0; k < 1000; ++k) {
      const double q = angle(random);
      double alone[2], among[2][19];
      kernels->sine_cosine(&q, 1, &alone[0], &alone[1]);
      std::vector<double> angles(19, k % 2 == 0 ? 1e6 : 1.);
      const int place = k % 19;
      angles[place] = q;
      kernels->sine_cosine(angles.data(), 19, among[0], among[1]);
      EXPECT_EQ(alone[0], among[0][place]) << place;
      EXPECT_EQ(alone[1], among[1][place]) << place;
    }
  }
}

TEST(Kernels, WhatIsNoAngleHasNoSine) {
  const double nan = std::nan(""),
               inf = std::numeric_limits<double>::infinity();
  const std::vector<double> angles = {0, nan, 1, inf, -inf, 2, nan, 3};
  for (const Kernels* kernels : AvailableKernels()) {
    std::vector<double> sine(8), cosine(8);
    kernels->sine_cosine(angles.data(), 8, sine.data(), cosine.data());
    for (int k = 0; k < 8; ++k) {
      EXPECT_EQ(std::isnan(sine[k]), !std::isfinite(angles[k])) << k;
      EXPECT_EQ(std::isnan(cosine[k]), !std::isfinite(angles[k])) << k;
    }
  }
}

TEST(Kernels, BaselineIsEverywhere) {
  ASSERT_FALSE(AvailableKernels().empty());
  EXPECT_STREQ(AvailableKernels().front()->instruction_set, "baseline");
}

}  // namespace
}  // namespace armcal::simd
