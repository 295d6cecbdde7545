#include "calib/diagnose/data/chi2_given.h"

#include <gtest/gtest.h>

#include <random>

namespace armcal::chi2_given_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Two joints with columns of their own and a common one, weighed rows, other
// data, and torques of which some act on one joint alone.
TEST(Chi2Given, IsTheSquareOfWhatIsLeft) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto draw = [&](int rows, int columns) -> MatrixXd {
    return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
  };
  BaselineFit fit({{{0, 1}, draw(43, 2)}, {{1, 2}, draw(30, 2)}}, 3,
                  {draw(43, 1), draw(30, 1)});
  fit.AddKnown({{{0, 1}, draw(5, 2)}, {{1, 2}, draw(6, 2)}},
               {draw(5, 1), draw(6, 1)});
  fit.Weigh(Eigen::Vector2d(.7, 3));
  fit.Scale({1}, 2);
  fit.Factor();
  std::vector<JointRows> torques = {{VectorXd(), VectorXd()}};
  for (int k = 0; k < 9; ++k) {
    torques.push_back({draw(43, 1), draw(30, 1)});
    torques.push_back({VectorXd(), draw(30, 1)});
  }
  const VectorXd chi2 = Chi2Given(fit, torques);
  for (size_t k = 0; k < torques.size(); ++k) {
    EXPECT_NEAR(chi2[k], fit.ResidualGiven(torques[k]).squaredNorm(), 1e-9)
        << k;
  }
}

}  // namespace armcal::chi2_given_test
