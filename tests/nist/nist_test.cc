// NIST's certified nonlinear regressions through the solver and the covariance
// that calibrate uses, and through Ceres as it comes.

#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numeric>

#include "calib/numerics/posterior.h"
#include "problems/dense_solver.h"
#include "tests/nist/nist_set.h"

namespace armcal::nist_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Estimate {
  VectorXd value, stddev;
};

// Of unit variance to that of the residuals.
double ResidualStddev(const NistSet& set, const VectorXd& residuals) {
  return residuals.norm() / std::sqrt(set.y.size() - set.value.size());
}

Estimate Ours(const NistSet& set, const VectorXd& start) {
  Estimate estimate{start, {}};
  ceres::Problem problem;
  problem.AddResidualBlock(new NistResidual(set), nullptr,
                           estimate.value.data());
  SolveDense(1e-15, &problem);
  const Eigen::Index n = start.size();
  VectorXd residuals(set.y.size());
  RowMajor J(set.y.size(), n);
  const double* const at = estimate.value.data();
  double* jacobian = J.data();
  NistResidual(set).Evaluate(&at, residuals.data(), &jacobian);
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  estimate.stddev =
      Posterior(J, MatrixXd::Zero(n, n), all).Gain().diagonal().cwiseSqrt() *
      ResidualStddev(set, residuals);
  return estimate;
}

// Ceres as it comes, or with the tightest tolerances, as its own
// examples/nist.cc has it.
Estimate OfCeres(const NistSet& set, const VectorXd& start, bool tight) {
  Estimate estimate{start, VectorXd::Zero(start.size())};
  ceres::Problem problem;
  double* const x = estimate.value.data();
  problem.AddResidualBlock(new NistResidual(set), nullptr, x);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  if (tight) {
    options.max_num_iterations = 10000;
    options.function_tolerance = options.gradient_tolerance =
        options.parameter_tolerance = std::numeric_limits<double>::epsilon();
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  ceres::Covariance::Options how;
  how.algorithm_type = ceres::SPARSE_QR;
  ceres::Covariance covariance(how);
  const std::vector<std::pair<const double*, const double*>> blocks = {{x, x}};
  RowMajor C(start.size(), start.size());
  if (!covariance.Compute(blocks, &problem)) return estimate;
  covariance.GetCovarianceBlock(x, x, C.data());
  std::vector<double> residuals;
  problem.Evaluate({}, nullptr, &residuals, nullptr, nullptr);
  estimate.stddev =
      C.diagonal().cwiseSqrt() *
      ResidualStddev(set, VectorXd::Map(residuals.data(), residuals.size()));
  return estimate;
}

// Of the worst number: -log10 of its relative error, at most NIST's 11.
double Digits(const VectorXd& x, const VectorXd& certified) {
  double worst = 11;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double error = std::abs(x[k] / certified[k] - 1);
    worst = std::min(worst, error > 0 ? -std::log10(error) : 11);
    if (!std::isfinite(x[k])) worst = 0;
  }
  return worst > 0 ? worst : 0;
}

struct Solver {
  const char* name;
  Estimate (*solve)(const NistSet& set, const VectorXd& start);
  int values = 0, stddevs = 0;  // sets that are right from both starts
};

TEST(Nist, CertifiedValuesAndDeviations) {
  if (!std::filesystem::exists(NIST_DIR "/Thurber.dat")) {
    GTEST_SKIP() << "SKIPPED: the 27 sets of NIST are not in " << NIST_DIR
                 << "; tests/nist/fetch.py fetches them";
  }
  using Set = const NistSet&;
  using Start = const VectorXd&;
  Solver solvers[] = {
      {"armcal", Ours},
      {"Ceres", [](Set s, Start x) { return OfCeres(s, x, false); }},
      {"Ceres, tight", [](Set s, Start x) { return OfCeres(s, x, true); }}};
  std::printf("Digits of values, of standard deviations\nset, start");
  for (const Solver& solver : solvers) std::printf("  %12s", solver.name);
  for (const std::string& name : NistNames()) {
    const NistSet set = ReadNistSet(NIST_DIR, name);
    for (Solver& solver : solvers) ++solver.values, ++solver.stddevs;
    bool wrong[3][2] = {};
    for (int s = 0; s < 2; ++s) {
      std::printf("\n%-8s %d", name.c_str(), s + 1);
      for (int by = 0; by < 3; ++by) {
        const Estimate estimate = solvers[by].solve(set, set.start[s]);
        const double value = Digits(estimate.value, set.value);
        const double stddev = Digits(estimate.stddev, set.stddev);
        std::printf("   %5.1f %5.1f", value, stddev);
        wrong[by][0] |= value < 6;
        wrong[by][1] |= stddev < 4;
      }
    }
    for (int by = 0; by < 3; ++by) {
      solvers[by].values -= wrong[by][0];
      solvers[by].stddevs -= wrong[by][1];
    }
  }
  std::printf("\nof 27    ");
  for (const Solver& solver : solvers) {
    std::printf("   %5d %5d", solver.values, solver.stddevs);
  }
  std::printf("\n");
  EXPECT_GE(solvers[0].values, 26);
  EXPECT_GE(solvers[0].stddevs, 25);
}

}  // namespace armcal::nist_test
