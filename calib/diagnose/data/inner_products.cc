#include "calib/diagnose/data/inner_products.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Columns = Eigen::Ref<const MatrixXd>;

// Rows that the kernel takes: whole groups of eight.
Index WholeGroups(Index rows) { return rows / 8 * 8; }

// Of a's columns from the begin to `a_end` with b's `columns` from `begin` on,
// as many of a's at a time as stay in the cache while all of b's pass.
MatrixXd OfWholeRows(const Columns& a, Index a_end, const Columns& b,
                     Index begin, Index columns) {
  constexpr Index kAtATime = 48;
  MatrixXd products(a_end, columns);
  MatrixXd some;
  if (products.size() == 0) return products;
  for (Index first = 0; first < a_end; first += kAtATime) {
    const Index count = std::min(kAtATime, a_end - first);
    some.resize(count, columns);
    simd::BestKernels().inner_products(
        a.col(first).data(), a.outerStride(), static_cast<int>(count),
        b.col(begin).data(), b.outerStride(), static_cast<int>(columns),
        WholeGroups(a.rows()), some.data());
    products.middleRows(first, count) = some;
  }
  return products;
}

}  // namespace

// a' b by the widest vectors that the machine has, in blocks of eight rows;
// what is left over, fewer than eight rows, by plain products. Screens are made
// of these.
MatrixXd InnerProducts(const Columns& a, const Columns& b) {
  if (a.cols() == 0 || b.cols() == 0) return MatrixXd(a.cols(), b.cols());
  MatrixXd products = OfWholeRows(a, a.cols(), b, 0, b.cols());
  const Index rest = a.rows() - WholeGroups(a.rows());
  products += a.bottomRows(rest).transpose() * b.bottomRows(rest);
  return products;
}

// Blocks of columns, each with those before it and its own; the products of
// later columns with earlier ones are the same numbers. Blocks are independent
// of each other, so that threads share them.
MatrixXd InnerProductsWithLast(const Columns& a, Index count) {
  constexpr Index kBlock = 96;
  const Index before = a.cols() - count;
  MatrixXd products(a.cols(), count);
  if (products.size() == 0) return products;
  tbb::parallel_for(Index{0}, (count + kBlock - 1) / kBlock, [&](Index block) {
    const Index begin = block * kBlock;
    const Index size = std::min(kBlock, count - begin);
    const Index end = before + begin + size;
    products.block(0, begin, end, size) =
        OfWholeRows(a, end, a, before + begin, size);
    products.block(before + begin, 0, size, begin) =
        products.block(before, begin, begin, size).transpose();
  });
  const Index rest = a.rows() - WholeGroups(a.rows());
  products +=
      a.bottomRows(rest).transpose() * a.rightCols(count).bottomRows(rest);
  return products;
}

}  // namespace armcal
