#include "calib/diagnose/judge/where.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::where_test {

constexpr int kSamples = 3000;

// What a joint did, each coordinate independent of the others, and unit noise.
JointCourse Course(std::mt19937_64* random) {
  JointCourse course;
  course.position = UniformVector(random, kSamples, -1.5, 1.5);
  course.velocity = UniformVector(random, kSamples, -1, 1);
  course.acceleration = UniformVector(random, kSamples, -4, 4);
  course.load = UniformVector(random, kSamples, -20, 20);
  course.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 40);
  course.residual.resize(kSamples);
  for (double& r : course.residual) r = Normal(random);
  return course;
}

double Direction(double v) { return v > 0 ? 1 : -1; }

struct Order {
  const char* by;
  std::function<double(const JointCourse& course, int k)> residual;
};
void PrintTo(const Order& order, std::ostream* out) { *out << order.by; }

class ResidualOrdered : public testing::TestWithParam<Order> {};

TEST_P(ResidualOrdered, ByWhatMakesIt) {
  std::mt19937_64 random(1);
  JointCourse course = Course(&random);
  for (int k = 0; k < kSamples; ++k) {
    course.residual[k] += GetParam().residual(course, k);
  }
  const Organisation organised = OrganisedBy(course);
  EXPECT_EQ(organised.by, GetParam().by);
  EXPECT_GT(organised.excess, 100);
}

using C = const JointCourse&;
INSTANTIATE_TEST_SUITE_P(
    Laws, ResidualOrdered,
    testing::Values(
        Order{"velocity",
              [](C c, int k) { return std::pow(c.velocity[k], 2); }},
        // Stribeck's: friction that falls within 0.1 rad/s.
        Order{"speed",
              [](C c, int k) {
                return 3 * Direction(c.velocity[k]) *
                       std::exp(-std::pow(c.velocity[k] / .1, 2));
              }},
        Order{"position",
              [](C c, int k) { return std::sin(3 * c.position[k]); }},
        Order{"acceleration", [](C c, int k) { return c.acceleration[k] / 4; }},
        Order{"load", [](C c, int k) { return c.load[k] / 20; }},
        // Friction that grows with what the gear carries.
        Order{"load and direction",
              [](C c, int k) {
                return (std::abs(c.load[k]) / 10 - 1) *
                       Direction(c.velocity[k]);
              }},
        Order{"time", [](C c, int k) { return c.time[k] / 40; }}));

TEST(ResidualUnordered, HasNoName) {
  for (int seed = 1; seed <= 50; ++seed) {
    std::mt19937_64 random(seed);
    EXPECT_EQ(OrganisedBy(Course(&random)).by, "") << seed;
  }
}

// Ten bins of 300 samples whose means are +-0.5, less 35 that noise may have.
TEST(ResidualOrderedExcess, IsChiSquaredOfTheBinsMeans) {
  std::mt19937_64 random(1);
  JointCourse course = Course(&random);
  course.position = Eigen::VectorXd::LinSpaced(kSamples, -1.5, 1.5);
  course.residual = course.position.cwiseSign() * .5;
  EXPECT_NEAR(OrganisedBy(course).excess, 750 - 35, 1e-9);
}

TEST(ResidualOrderedExcess, IsNoneOfAFewSamples) {
  JointCourse course;
  for (Eigen::VectorXd* x :
       {&course.residual, &course.position, &course.velocity,
        &course.acceleration, &course.load, &course.time}) {
    *x = Eigen::VectorXd::LinSpaced(40, -100, 100);
  }
  EXPECT_EQ(OrganisedBy(course).by, "");
}

// Noise of which this log has twice as much as the one that told it.
TEST(ResidualUnordered, EvenWhereItIsLouder) {
  std::mt19937_64 random(2);
  int ordered = 0;
  for (int run = 0; run < 40; ++run) {
    JointCourse course = Course(&random);
    course.residual *= 1.5;
    ordered += !OrganisedBy(course).by.empty();
  }
  EXPECT_LE(ordered, 1);
}

}  // namespace armcal::where_test
