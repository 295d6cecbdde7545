#include "model/simd/kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace armcal::simd::kernels_test {

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

// Against the library's, over all sizes; where tanh is x, to the last bit but
// three.
TEST(Kernels, HyperbolicTangentsAreTheLibrarys) {
  std::mt19937 random(4);
  std::vector<double> numbers = {0, 1e-300, -1e-300, 19.9, -20.1, 1e300};
  numbers.push_back(std::numeric_limits<double>::infinity());
  for (const double range : {1e-9, 1e-3, .3, 1., 10., 50.}) {
    std::uniform_real_distribution<double> number(-range, range);
    for (int k = 0; k < 5003; ++k) numbers.push_back(number(random));
  }
  const long count = static_cast<long>(numbers.size());
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    std::vector<double> result(count);
    for (const double width : {1., .003}) {
      kernels->hyperbolic_tangent(numbers.data(), width, count, result.data());
      for (long k = 0; k < count; ++k) {
        const double expected = std::tanh(numbers[k] / width);
        EXPECT_NEAR(result[k], expected, 1e-15 * std::abs(expected))
            << numbers[k];
      }
    }
    const double nan = std::nan("");
    kernels->hyperbolic_tangent(&nan, 1, 1, result.data());
    EXPECT_TRUE(std::isnan(result[0]));
  }
}

TEST(Kernels, MediansAreThoseOfSorting) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> number(-30, 30);  // many are equal
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    for (const int reach : {0, 1, 4, 15}) {
      std::vector<double> x(200), medians(200);
      for (double& v : x) v = number(random);
      kernels->sliding_medians(x.data(), 200, reach, medians.data());
      for (int k = reach; k + reach < 200; ++k) {
        std::vector<double> window(x.begin() + k - reach,
                                   x.begin() + k + reach + 1);
        std::sort(window.begin(), window.end());
        EXPECT_EQ(medians[k], window[reach]) << reach << " " << k;
      }
    }
  }
}

// Of small integers, which are exact in any order.
TEST(Kernels, InnerProductsOfTwoAddUp) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> number(-9, 9);
  const long stride = 40;
  std::vector<double> a[2], b[2];
  for (int p = 0; p < 2; ++p) {
    a[p].resize(20 * stride), b[p].resize(20 * stride);
    for (double& x : a[p]) x = number(random);
    for (double& x : b[p]) x = number(random);
  }
  const ColumnPair pairs[] = {{a[0].data(), stride, b[0].data(), stride},
                              {a[1].data(), stride, b[1].data(), stride}};
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    for (const int columns_a : {1, 4, 5, 8, 11}) {
      for (const int columns_b : {1, 3, 7}) {
        std::vector<double> products(columns_a * columns_b);
        kernels->inner_products_of_two(pairs, columns_a, columns_b, 24,
                                       products.data());
        for (int c = 0; c < columns_b; ++c) {
          for (int i = 0; i < columns_a; ++i) {
            double sum = 0;
            for (int p = 0; p < 2; ++p) {
              for (long r = 0; r < 24; ++r) {
                sum += a[p][i * stride + r] * b[p][c * stride + r];
              }
            }
            EXPECT_EQ(products[c * columns_a + i], sum);
          }
        }
      }
    }
  }
}

// Against the difference equation, a signal after the other; the last is alone
// in its registers.
TEST(Kernels, FiltersBothWays) {
  const FilterSection sections[] = {{.02, -1.6, .7}, {.03, -1.7, .8}};
  constexpr int kRows = 300, kWidth = 24;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> x(kRows * kWidth);
  for (double& v : x) v = number(random);
  for (const Kernels* kernels : AvailableKernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    std::vector<double> y = x;
    kernels->filter_both_ways(sections, y.data(), kRows, kWidth);
    for (int c = 0; c < kWidth; ++c) {
      std::vector<double> z(kRows);
      for (int k = 0; k < kRows; ++k) z[k] = x[k * kWidth + c];
      for (int way = 0; way < 2; ++way) {
        const double rest = z[0];
        for (const FilterSection& s : sections) {
          double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
          for (double& v : z) {
            const double x0 = v - rest;
            const double y0 = s.b * (x0 + 2 * x1 + x2) - s.a1 * y1 - s.a2 * y2;
            x2 = x1, x1 = x0, y2 = y1, y1 = y0;
            v = y0 + rest;
          }
        }
        std::reverse(z.begin(), z.end());
      }
      for (int k = 0; k < kRows; ++k)
        EXPECT_NEAR(y[k * kWidth + c], z[k], 1e-12);
    }
  }
}

TEST(Kernels, BaselineIsEverywhere) {
  ASSERT_FALSE(AvailableKernels().empty());
  EXPECT_STREQ(AvailableKernels().front()->instruction_set, "baseline");
}

}  // namespace armcal::simd::kernels_test
