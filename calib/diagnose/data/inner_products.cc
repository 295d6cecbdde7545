#include "calib/diagnose/data/inner_products.h"

#include "model/simd/kernels.h"

namespace armcal {

// a' b by the widest vectors that the machine has, in blocks of eight rows;
// what is left over, fewer than eight rows, by plain products. Screens are made
// of these.
Eigen::MatrixXd InnerProducts(const Eigen::MatrixXd& a,
                              const Eigen::MatrixXd& b) {
  const Eigen::Index whole = a.rows() / 8 * 8, rest = a.rows() - whole;
  Eigen::MatrixXd products(a.cols(), b.cols());
  if (products.size() == 0) return products;
  simd::BestKernels().inner_products(
      a.data(), a.rows(), static_cast<int>(a.cols()), b.data(), b.rows(),
      static_cast<int>(b.cols()), whole, products.data());
  products += a.bottomRows(rest).transpose() * b.bottomRows(rest);
  return products;
}

}  // namespace armcal
