#pragma once

#include <string>
#include <vector>

#include "calib/compare/compared_result.h"

namespace armcal {

// A value that two results have.
struct ValueDifference {
  std::string name, unit;
  double a, b;
  double a_stddev, b_stddev;  // 0: exact
  // b - a in standard deviations of the difference; NaN where none is known.
  double deviations;
  bool differs;  // beyond noise
};

// What two results say of one robot, the errors of the one taken for
// independent of the other's.
struct Agreement {
  std::vector<ValueDifference> values;  // that both know
  // Of all values together: the sum of squares of `deviations`, as how many
  // independent ones it scatters, and the probability of so much or more by
  // noise. (Not d' (P_a + P_b)^-1 d: that hangs on the sharpest combinations,
  // of which a covariance that was estimated from as many scores as there are
  // parameters, or a few times as many, tells little.)
  double sum_of_squares = 0;
  double degrees = 0;
  double probability = 1;
  double MeanSquare() const;  // of `deviations`, where there are some
  // Sentences; empty: they agree within noise.
  std::vector<std::string> disagreements;
  // Values that one of them alone knows are not compared.
  std::vector<std::string> only_a, only_b;
};

// Compares values and claims of two results that are of one kind, or of which
// at least one is a robot. `errors`: how often at most two results of one robot
// may be found to disagree by noise alone, shared equally between the test of
// all values together and those of each (Bonferroni).
//
// Exact values, of robots, differ by more than rounding (1e-9) or not at all.
// Of diagnoses, an effect that one claims has to be claimed by the other, to be
// named among what the other's claim may be instead, or not be testable there.
Agreement CompareTwo(const ComparedResult& a, const ComparedResult& b,
                     double errors);

// "1.25 +- 0.03"; exact values with more digits.
std::string WithStddev(double value, double stddev);
// "= 0.03", "below 1e-12".
std::string ProbabilityText(double probability);

}  // namespace armcal
