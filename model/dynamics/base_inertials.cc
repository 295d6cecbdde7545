#include "model/dynamics/base_inertials.h"

#include <Eigen/QR>
#include <algorithm>

#include "model/dynamics/batch_regressor.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStates = 8;  // 16 equations for each link
// What remains of a column when others are taken off, beside the largest column
// of its kind: less is rounding.
constexpr double kNothing = 1e-11;

MatrixXd Draw(int n, double range, std::mt19937_64* random) {
  MatrixXd x(kStates, n);
  for (double& value : x.reshaped()) {
    value = range * (2 * UniformDraw(random) - 1);
  }
  return x;
}

// P and D of all joints at some states, one below the other.
MatrixXd MomentumColumns(const Robot& robot) {
  const int n = robot.num_joints();
  std::mt19937_64 random(1);
  const MatrixXd q = Draw(n, 3, &random), qd = Draw(n, 2, &random);
  MatrixXd A = MatrixXd::Zero(2 * n * kStates, 10 * n);
  std::vector<double*> P, D;
  for (int i = 0; i < n; ++i) {
    P.push_back(&A(2 * i * kStates, 10 * i));
    D.push_back(P.back() + kStates);
  }
  BatchRegressor(robot).Momentum({q, qd, {}, {}}, kStates, P.data(), D.data(),
                                 A.rows());
  return A;
}

// 1 of a mass, a first and a second moment, in that unit of length in which the
// largest columns of all three are alike.
VectorXd Scales(const MatrixXd& A) {
  const VectorXd norms = A.colwise().norm();
  VectorXd scales(norms.size());
  double largest[3] = {1e-300, 1e-300, 1e-300};
  const auto kind = [](Eigen::Index c) {
    return c % 10 == 0 ? 0 : c % 10 < 4 ? 1 : 2;
  };
  for (Eigen::Index c = 0; c < norms.size(); ++c) {
    largest[kind(c)] = std::max(largest[kind(c)], norms[c]);
  }
  for (Eigen::Index c = 0; c < norms.size(); ++c) {
    scales[c] = 1 / largest[kind(c)];
  }
  return scales;
}

}  // namespace

// From the base on, as the first links' columns are in the fewest equations; of
// a link, what differs most first.
BaseInertials::BaseInertials(const Robot& robot) {
  MatrixXd A = MomentumColumns(robot);
  const VectorXd scales = Scales(A);
  A = A * scales.asDiagonal();
  MatrixXd rest = A, Q(A.rows(), 0);
  for (Eigen::Index begin = 0; begin < A.cols(); begin += 10) {
    auto link = rest.middleCols(begin, 10);
    for (int pass = 0; pass < 2; ++pass) link -= Q * (Q.transpose() * link);
    Eigen::Index next;
    while (link.colwise().norm().maxCoeff(&next) > kNothing) {
      columns.push_back(static_cast<int>(begin + next));
      const VectorXd q = link.col(next).normalized();
      Q.conservativeResize(Eigen::NoChange, Q.cols() + 1);
      Q.rightCols<1>() = q;
      for (int pass = 0; pass < 2; ++pass) {
        link -= (q * (q.transpose() * link)).eval();
      }
      link.col(next).setZero();
    }
  }
  std::sort(columns.begin(), columns.end());
  const auto size = static_cast<Eigen::Index>(columns.size());
  if (size == 0) {
    combinations.resize(0, A.cols());
    return;
  }
  const MatrixXd chosen = A(Eigen::all, columns);
  combinations = chosen.householderQr().solve(A);
  combinations = VectorXd(scales(columns)).asDiagonal() * combinations *
                 scales.cwiseInverse().asDiagonal();
  combinations(Eigen::all, columns).setIdentity();
}

}  // namespace armcal
