#include "problems/drive_gain_residual.h"

#include <gtest/gtest.h>

#include "tests/fixtures/sample_robots.h"

namespace armcal::drive_gain_residual_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kJoints = 3, kParameters = 4, kRows = 5;

MatrixXd Random(std::mt19937_64* random, int rows, int columns) {
  MatrixXd A(rows, columns);
  for (double& x : A.reshaped()) x = Uniform(random, -1, 1);
  return A;
}

struct Example {
  Example() {
    for (int j = 0; j < kJoints; ++j) {
      for (const bool loaded : {false, true}) {
        if (j == 1 && loaded) continue;
        equations.push_back({j, loaded, Random(&random, kRows, kParameters),
                             UniformVector(&random, kRows, -1, 1)});
      }
    }
    B = Random(&random, kParameters, 10);
    g = UniformVector(&random, kJoints, .5, 2);
    x = UniformVector(&random, kParameters, -1, 1);
    p = UniformVector(&random, 10, -1, 1);
  }
  VectorXd Residual(const VectorXd& g_in, const VectorXd& x_in,
                    const VectorXd& p_in) const {
    const DriveGainResidual residual(equations, kJoints, B);
    VectorXd r(residual.num_residuals());
    const double* const parameters[] = {g_in.data(), x_in.data(), p_in.data()};
    EXPECT_TRUE(residual.Evaluate(parameters, r.data(), nullptr));
    return r;
  }

  std::mt19937_64 random{1};
  std::vector<CurrentEquations> equations;
  MatrixXd B;
  VectorXd g, x, p;
};

// g A (x + B p) - z, equation by equation.
TEST(DriveGainResidual, IsCurrentOfTorqueLessCurrent) {
  const Example e;
  const VectorXd r = e.Residual(e.g, e.x, e.p);
  int at = 0;
  for (const CurrentEquations& equations : e.equations) {
    for (int k = 0; k < kRows; ++k, ++at) {
      double torque = 0;
      for (int c = 0; c < kParameters; ++c) {
        double parameter = e.x[c];
        for (int l = 0; equations.loaded && l < 10; ++l) {
          parameter += e.B(c, l) * e.p[l];
        }
        torque += equations.A(k, c) * parameter;
      }
      EXPECT_NEAR(r[at], e.g[equations.joint] * torque - equations.z[k], 1e-14);
    }
  }
  EXPECT_EQ(at, r.size());
}

// What no current shows.
TEST(DriveGainResidual, DoesNotKnowTheCommonScale) {
  const Example e;
  const VectorXd r = e.Residual(e.g, e.x, e.p);
  EXPECT_LT((e.Residual(7 * e.g, e.x / 7, e.p / 7) - r).norm(), 1e-13);
  EXPECT_GT((e.Residual(7 * e.g, e.x / 7, e.p) - r).norm(), .1);
}

TEST(DriveGainResidual, JacobiansAreThoseOfDifferences) {
  const Example e;
  const DriveGainResidual residual(e.equations, kJoints, e.B);
  const int rows = residual.num_residuals();
  VectorXd r(rows);
  RowMajor by_g(rows, kJoints), by_x(rows, kParameters), by_p(rows, 10);
  const double* const parameters[] = {e.g.data(), e.x.data(), e.p.data()};
  double* jacobians[] = {by_g.data(), by_x.data(), by_p.data()};
  ASSERT_TRUE(residual.Evaluate(parameters, r.data(), jacobians));
  constexpr double kStep = 1e-6;
  for (int block = 0; block < 3; ++block) {
    const RowMajor& J = block == 0 ? by_g : block == 1 ? by_x : by_p;
    for (int c = 0; c < J.cols(); ++c) {
      const auto moved = [&](double step) {
        VectorXd v[] = {e.g, e.x, e.p};
        v[block][c] += step;
        return e.Residual(v[0], v[1], v[2]);
      };
      const VectorXd difference = (moved(kStep) - moved(-kStep)) / (2 * kStep);
      EXPECT_LT((J.col(c) - difference).norm(), 1e-8) << block << " " << c;
    }
  }
}

}  // namespace armcal::drive_gain_residual_test
