#include "calib/compare/agreement.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <map>

#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Names = std::vector<std::string>;

constexpr double kSameNumber = 1e-9;  // relative, of values that are exact

struct Pair {
  int a, b;  // places of one value in two sets
};

bool IsKnown(const ComparedValue& value) {
  return std::isfinite(value.value) && std::isfinite(value.stddev);
}

// Values of one name and unit that both know; the names of others.
std::vector<Pair> Match(const ComparedValues& a, const ComparedValues& b,
                        Names* only_a, Names* only_b) {
  std::map<std::string, int> places;
  for (size_t k = 0; k < b.values.size(); ++k) {
    if (IsKnown(b.values[k])) places[b.values[k].name] = static_cast<int>(k);
  }
  std::vector<Pair> pairs;
  for (size_t k = 0; k < a.values.size(); ++k) {
    const ComparedValue& value = a.values[k];
    if (!IsKnown(value)) continue;
    const auto other = places.find(value.name);
    if (other == places.end() || b.values[other->second].unit != value.unit) {
      only_a->push_back(value.name);
      continue;
    }
    pairs.push_back({static_cast<int>(k), other->second});
    places.erase(other);
  }
  for (const auto& [name, place] : places) only_b->push_back(name);
  return pairs;
}

// Of values in this order.
MatrixXd CovarianceOf(const ComparedValues& set, const std::vector<int>& at) {
  if (set.covariance.size() > 0) return set.covariance(at, at);
  VectorXd variances(at.size());
  for (size_t k = 0; k < at.size(); ++k) {
    variances[static_cast<Eigen::Index>(k)] =
        std::pow(set.values[at[k]].stddev, 2);
  }
  return variances.asDiagonal();
}

// The sum of squares of differences d in their own deviations, of covariance P.
// It is a sum of chi squared of one times the eigenvalues of the correlations
// R, nearly that of h times tr R^2 / tr R (Box 1954).
void AddSumOfSquares(const VectorXd& d, const MatrixXd& P, Agreement* result) {
  if (d.size() == 0) return;
  const VectorXd scale = P.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd R = scale.asDiagonal() * P * scale.asDiagonal();
  result->sum_of_squares = scale.cwiseProduct(d).squaredNorm();
  result->degrees = std::pow(R.trace(), 2) / R.squaredNorm();
  const double factor = R.squaredNorm() / R.trace();
  result->probability = boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(result->degrees),
                              result->sum_of_squares / factor));
}

// b - a; angles of a robot are the same after a whole turn.
double Apart(const ComparedValue& a, const ComparedValue& b, bool of_robots) {
  const double apart = b.value - a.value;
  const bool turns = of_robots && a.unit == "rad";
  return turns ? std::remainder(apart, 2 * M_PI) : apart;
}

ValueDifference Difference(const ComparedValue& a, const ComparedValue& b,
                           double apart, double most) {
  ValueDifference d{a.name,   a.unit,   a.value, b.value,
                    a.stddev, b.stddev, NAN,     false};
  const double stddev = std::hypot(a.stddev, b.stddev);
  if (stddev > 0) {
    d.deviations = apart / stddev;
    d.differs = std::abs(d.deviations) > most;
  } else {
    const double size = std::max(std::abs(a.value), std::abs(b.value));
    d.differs = std::abs(apart) > kSameNumber * size + 1e-12;
  }
  return d;
}

std::string Sentence(const ValueDifference& d) {
  std::string text = d.name + " is " + WithStddev(d.a, d.a_stddev) +
                     " against " + WithStddev(d.b, d.b_stddev) + " " + d.unit;
  if (!std::isnan(d.deviations)) {
    text += Format(" (%.1f standard deviations)", std::abs(d.deviations));
  }
  return text;
}

// The first sets of values that both have some of in common.
void CompareValues(const ComparedResult& a, const ComparedResult& b,
                   double errors, Agreement* result) {
  const bool of_robots = a.kind == ComparedResult::Kind::kCalibration ||
                         a.kind == ComparedResult::Kind::kRobot;
  for (const ComparedValues& of_a : a.sets) {
    for (const ComparedValues& of_b : b.sets) {
      Names only_a, only_b;
      const std::vector<Pair> pairs = Match(of_a, of_b, &only_a, &only_b);
      if (pairs.empty()) continue;
      result->only_a = only_a, result->only_b = only_b;
      const double each = errors / 2 / pairs.size();
      const double most = boost::math::quantile(
          boost::math::complement(boost::math::normal(), each / 2));
      std::vector<int> at_a, at_b;
      VectorXd d(pairs.size());
      for (const auto& [k_a, k_b] : pairs) {
        const double apart =
            Apart(of_a.values[k_a], of_b.values[k_b], of_robots);
        result->values.push_back(
            Difference(of_a.values[k_a], of_b.values[k_b], apart, most));
        const ValueDifference& last = result->values.back();
        if (last.differs) result->disagreements.push_back(Sentence(last));
        if (std::isnan(last.deviations)) continue;
        d[static_cast<Eigen::Index>(at_a.size())] = apart;
        at_a.push_back(k_a), at_b.push_back(k_b);
      }
      AddSumOfSquares(d.head(at_a.size()),
                      CovarianceOf(of_a, at_a) + CovarianceOf(of_b, at_b),
                      result);
      if (result->probability < errors / 2) {
        result->disagreements.push_back(
            Format("all values together differ more than noise does: squares "
                   "of deviations are %.3g in the mean (p %s)",
                   result->MeanSquare(),
                   ProbabilityText(result->probability).c_str()));
      }
      return;
    }
  }
}

bool Holds(const Names& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) > 0;
}

// Whether a diagnosis has this effect, may have it, or cannot tell.
bool Allows(const ComparedResult& diagnosis, const ComparedClaim& claim) {
  for (const ComparedClaim& other : diagnosis.claims) {
    if (other.name == claim.name || Holds(other.rivals, claim.name) ||
        Holds(claim.rivals, other.name)) {
      return true;
    }
  }
  return Holds(diagnosis.untestable, claim.name);
}

void CompareClaims(const ComparedResult& a, const ComparedResult& b,
                   Agreement* result) {
  const auto add = [result](const ComparedResult& one,
                            const ComparedResult& other) {
    for (const ComparedClaim& claim : one.claims) {
      if (!claim.claimed || Allows(other, claim)) continue;
      result->disagreements.push_back(Format(
          "%s is found in %s (%.0f %%) and not in %s", claim.name.c_str(),
          one.name.c_str(), 100 * claim.probability, other.name.c_str()));
    }
  };
  add(a, b), add(b, a);
}

}  // namespace

double Agreement::MeanSquare() const {
  const auto known = std::count_if(
      values.begin(), values.end(),
      [](const ValueDifference& d) { return !std::isnan(d.deviations); });
  return sum_of_squares / static_cast<double>(known);
}

std::string WithStddev(double value, double stddev) {
  return stddev > 0 ? Format("%.4g +- %.2g", value, stddev)
                    : Format("%.6g", value);
}

std::string ProbabilityText(double probability) {
  constexpr double kLeast = 1e-12;  // below, normal tails are a fiction
  return probability < kLeast ? "below 1e-12" : Format("= %.2g", probability);
}

Agreement CompareTwo(const ComparedResult& a, const ComparedResult& b,
                     double errors) {
  Agreement result;
  CompareValues(a, b, errors, &result);
  CompareClaims(a, b, &result);
  if (a.kind == ComparedResult::Kind::kVerification && a.verdict != b.verdict) {
    result.disagreements.push_back(a.name + " is " + a.verdict + ", " + b.name +
                                   " is " + b.verdict);
  }
  return result;
}

}  // namespace armcal
