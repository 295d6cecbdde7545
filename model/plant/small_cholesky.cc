#include "model/plant/small_cholesky.h"

#include <Eigen/Cholesky>
#include <type_traits>

namespace armcal {
namespace {

// Calls `body` with the size as a constant, Eigen::Dynamic beyond 8.
template <typename Body>
void WithSize(Eigen::Index n, const Body& body) {
  switch (n) {
    case 1:
      return body(std::integral_constant<int, 1>());
    case 2:
      return body(std::integral_constant<int, 2>());
    case 3:
      return body(std::integral_constant<int, 3>());
    case 4:
      return body(std::integral_constant<int, 4>());
    case 5:
      return body(std::integral_constant<int, 5>());
    case 6:
      return body(std::integral_constant<int, 6>());
    case 7:
      return body(std::integral_constant<int, 7>());
    case 8:
      return body(std::integral_constant<int, 8>());
    default:
      return body(std::integral_constant<int, Eigen::Dynamic>());
  }
}

template <int N>
using Square = Eigen::Matrix<double, N, N>;

}  // namespace

void SmallCholesky::Compute(const Eigen::MatrixXd& a) {
  const Eigen::Index n = a.rows();
  factor_.resize(n, n);
  WithSize(n, [&](auto size) {
    Eigen::Map<Square<size()>>(factor_.data(), n, n) =
        Eigen::LLT<Square<size()>>(
            Eigen::Map<const Square<size()>>(a.data(), n, n))
            .matrixLLT();
  });
}

Eigen::VectorXd SmallCholesky::Solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = b;
  const Eigen::Index n = b.size();
  WithSize(n, [&](auto size) {
    const Eigen::Map<const Square<size()>> factor(factor_.data(), n, n);
    Eigen::Map<Eigen::Matrix<double, size(), 1>> at(x.data(), n);
    factor.template triangularView<Eigen::Lower>().solveInPlace(at);
    factor.transpose().template triangularView<Eigen::Upper>().solveInPlace(at);
  });
  return x;
}

}  // namespace armcal
