#include "calib/compare/agreement.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "tests/fixtures/sample_motion.h"

namespace armcal::agreement_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Kind = ComparedResult::Kind;

ComparedResult Calibration(const std::string& name, const VectorXd& values,
                           const MatrixXd& covariance) {
  ComparedResult result{name, Kind::kCalibration, "arm", "", {}, {}, {}, {}};
  ComparedValues set;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    set.values.push_back({"p" + std::to_string(k), "kg", values[k],
                          std::sqrt(covariance(k, k))});
  }
  set.covariance = covariance;
  result.sets.push_back(set);
  return result;
}

// Of two values of deviation 1 each, twice, one apart: squares of 1/2 each. Of
// two that are independent chi squared exceeds 1 with a probability of
// exp(-1/2).
TEST(Agreement, IndependentSquaresAreChiSquared) {
  const MatrixXd P = MatrixXd::Identity(2, 2);
  const Agreement found =
      CompareTwo(Calibration("a", Eigen::Vector2d(3, 4), P),
                 Calibration("b", Eigen::Vector2d(4, 5), P), .01);
  EXPECT_NEAR(found.degrees, 2, 1e-12);
  EXPECT_NEAR(found.sum_of_squares, 1, 1e-12);
  EXPECT_NEAR(found.probability, std::exp(-.5), 1e-12);
  ASSERT_EQ(found.values.size(), 2u);
  EXPECT_NEAR(found.values[0].deviations, 1 / std::sqrt(2.), 1e-12);
  EXPECT_THAT(found.disagreements, IsEmpty());
}

// Two that are one: a normal deviation of 1 / sqrt(2).
TEST(Agreement, SquaresOfOneNumberAreOne) {
  const MatrixXd P = MatrixXd::Ones(2, 2);
  const Agreement found =
      CompareTwo(Calibration("a", Eigen::Vector2d(0, 0), P),
                 Calibration("b", Eigen::Vector2d(1, 1), P), .01);
  EXPECT_NEAR(found.degrees, 1, 1e-12);
  EXPECT_NEAR(found.probability, std::erfc(.5), 1e-9);
}

// Of results of one truth, as often as was allowed for at most. The two tests
// share it, and one event often sets off both: at least half of it is used.
TEST(Agreement, NoiseAloneRarelyDisagrees) {
  constexpr int kSize = 12, kRuns = 4000;
  constexpr double kErrors = .1;
  std::mt19937_64 random(1);
  MatrixXd A(kSize, kSize);
  for (double& x : A.reshaped()) x = Normal(&random);
  const MatrixXd P = A * A.transpose();
  const MatrixXd L = P.llt().matrixL();
  const auto draw = [&] {
    VectorXd u(kSize);
    for (double& x : u) x = Normal(&random);
    return Calibration("c", L * u, P);
  };
  int apart = 0;
  for (int k = 0; k < kRuns; ++k) {
    apart += !CompareTwo(draw(), draw(), kErrors).disagreements.empty();
  }
  EXPECT_LT(apart, kErrors * kRuns + 3 * std::sqrt(kErrors * kRuns));
  EXPECT_GT(apart, kErrors * kRuns / 2);
}

TEST(Agreement, NamesTheValueThatDiffers) {
  const MatrixXd P = MatrixXd::Identity(3, 3);
  const Agreement found =
      CompareTwo(Calibration("a", Eigen::Vector3d(0, 0, 0), P),
                 Calibration("b", Eigen::Vector3d(0, 8, 1), P), .01);
  EXPECT_FALSE(found.values[0].differs);
  EXPECT_TRUE(found.values[1].differs);
  EXPECT_FALSE(found.values[2].differs);
  EXPECT_THAT(found.disagreements[0],
              HasSubstr("p1 is 0 +- 1 against 8 +- 1 kg (5.7 standard"));
}

// Small differences of all values that add up.
TEST(Agreement, AllTogetherTellMoreThanEach) {
  constexpr int kSize = 40;
  const MatrixXd P = MatrixXd::Identity(kSize, kSize);
  const Agreement found =
      CompareTwo(Calibration("a", VectorXd::Zero(kSize), P),
                 Calibration("b", VectorXd::Constant(kSize, 2.2), P), .01);
  ASSERT_EQ(found.disagreements.size(), 1u);
  EXPECT_THAT(found.disagreements[0], HasSubstr("together"));
}

TEST(Agreement, RobotsAreExact) {
  const auto robot = [](double mass) {
    ComparedResult result{"r", Kind::kRobot, "arm", "", {}, {}, {}, {}};
    result.sets.push_back({{{"link.mass", "kg", mass, 0}}, {}});
    return result;
  };
  EXPECT_THAT(CompareTwo(robot(2), robot(2 + 1e-12), .01).disagreements,
              IsEmpty());
  EXPECT_THAT(CompareTwo(robot(2), robot(2 + 1e-6), .01).disagreements,
              ElementsAre(HasSubstr("link.mass is 2 against")));
}

// What only one of them knows is not compared, and told.
// A yaw of half a turn is one to either side. What a rollout is off by is no
// angle of a robot: after a whole turn it is another one.
TEST(Agreement, AnglesOfRobotsAreTheSameAfterATurn) {
  const auto result = [](Kind kind, double angle) {
    ComparedResult r{"r", kind, "arm", "", {}, {}, {}, {}};
    r.sets.push_back({{{"link.yaw", "rad", angle, 0}}, {}});
    return r;
  };
  for (const Kind kind : {Kind::kRobot, Kind::kCalibration}) {
    EXPECT_THAT(
        CompareTwo(result(kind, M_PI), result(kind, -M_PI), .01).disagreements,
        IsEmpty());
    EXPECT_THAT(CompareTwo(result(kind, M_PI), result(kind, -M_PI + 1e-3), .01)
                    .disagreements,
                ElementsAre(HasSubstr("link.yaw is")));
  }
  const Kind rollouts = Kind::kVerification;
  EXPECT_THAT(
      CompareTwo(result(rollouts, .5), result(rollouts, .5 + 2 * M_PI), .01)
          .disagreements,
      ElementsAre(HasSubstr("link.yaw is")));
}

TEST(Agreement, UnknownValuesAreNotCompared) {
  ComparedResult a =
      Calibration("a", Eigen::Vector2d(1, 2), MatrixXd::Identity(2, 2));
  ComparedResult b = a;
  b.sets[0].values[1].stddev = NAN;
  b.sets[0].values[1].value = 99;
  const Agreement found = CompareTwo(a, b, .01);
  EXPECT_EQ(found.values.size(), 1u);
  EXPECT_THAT(found.only_a, ElementsAre("p1"));
  EXPECT_THAT(found.disagreements, IsEmpty());
}

ComparedResult Diagnosis(const std::string& name,
                         const std::vector<ComparedClaim>& claims,
                         const std::vector<std::string>& untestable = {}) {
  return {name, Kind::kDiagnosis, "arm", "", {}, {{}}, claims, untestable};
}

TEST(Agreement, AClaimOfOneAloneIsADisagreement) {
  const ComparedClaim spring{"spring of elbow", .97, true, {}};
  const ComparedClaim cable{"cable of elbow", .8, true, {"spring of elbow"}};
  const ComparedClaim faint{"spring of elbow", .2, false, {}};
  const auto apart = [&](const ComparedResult& other) {
    return CompareTwo(Diagnosis("a", {spring}), other, .01).disagreements;
  };
  EXPECT_THAT(apart(Diagnosis("b", {})),
              ElementsAre("spring of elbow is found in a (97 %) and not in b"));
  EXPECT_THAT(apart(Diagnosis("b", {spring})), IsEmpty());
  EXPECT_THAT(apart(Diagnosis("b", {faint})), IsEmpty());
  EXPECT_THAT(apart(Diagnosis("b", {cable})), IsEmpty());
  EXPECT_THAT(apart(Diagnosis("b", {}, {"spring of elbow"})), IsEmpty());
}

}  // namespace armcal::agreement_test
