#include "problems/weak_rows.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

constexpr int kBatch = 64;  // samples evaluated together, within the cache

long Padded(long rows) { return (rows + 7) / 8 * 8; }

}  // namespace

// A window has `steps_` + 1 samples and at least 9, as the quadrature of phi
// needs some. Windows begin at cells, hop_ samples long, and reach over
// `phases_` of them: each cell's P and D are evaluated once and go into all
// windows over it.
WeakRows::WeakRows(const Trajectory& trajectory, const RowOptions& options,
                   const MotionFunctions& functions)
    : trajectory_(trajectory),
      functions_(functions),
      steps_(std::max(
          8, static_cast<int>(std::lround(options.window_s / trajectory.dt)))),
      hop_(std::max(1, steps_ / options.hops)),
      phases_(static_cast<int>((steps_ + hop_ - 1) / hop_)),
      weight_stride_(Padded(hop_)) {
  if (options.window_s > trajectory.size() * trajectory.dt) return;
  SetTestFunction();
  ListWindows();
}

// Tables the test function and its rate, s going from -1 to 1 in `steps_`:
//   phi = (1 - s^2)^4,
//   d phi/dt = -8 s (1 - s^2)^3 ds/dt,  ds/dt = 2 / (steps dt).
// Both are divided by the sum of phi, which makes phi's integral 1 and includes
// the trapezoid rule's dt. phi and its first three derivatives vanish at both
// ends, and with them the terms of low order of the trapezoid rule's error
// (Euler and Maclaurin's formula). A cell's samples stand in a column of each
// phase, so that a kernel takes all phases at once.
void WeakRows::SetTestFunction() {
  phi_.assign(weight_stride_ * phases_, 0);
  rate_ = phi_;
  double sum = 0;
  // At the last sample, `steps_`, both are 0.
  for (int k = 0; k < steps_; ++k) {
    const double s = 2.0 * k / steps_ - 1;
    const double u = 1 - s * s;
    const long at = (phases_ - 1 - k / hop_) * weight_stride_ + k % hop_;
    phi_[at] = u * u * u * u;
    rate_[at] = -8 * s * u * u * u * 2 / (steps_ * trajectory_.dt);
    sum += phi_[at];
  }
  for (double& x : phi_) x /= sum;
  for (double& x : rate_) x /= sum;
}

// Windows whose middle lies in the core, so that each belongs to one block.
// Those with a useless sample are left out: `useless` counts them up to each
// sample, and two equal counts mean that there is none between.
void WeakRows::ListWindows() {
  const long first = trajectory_.first_index;
  const long end = first + trajectory_.size();
  const long core_end = first + trajectory_.core_end;
  std::vector<int> useless(trajectory_.size() + 1, 0);  // before each sample
  for (int k = 0; k < trajectory_.size(); ++k) {
    useless[k + 1] = useless[k] + (functions_.Useless(k) ? 1 : 0);
  }
  const long begin =
      std::max(first, first + trajectory_.core_begin - steps_ / 2);
  for (long cell = (begin + hop_ - 1) / hop_;; ++cell) {
    const long sample = cell * hop_;
    if (sample + steps_ / 2 >= core_end || sample + steps_ >= end) break;
    const long k = sample - first;
    if (useless[k + steps_ + 1] == useless[k]) cells_.push_back(cell);
  }
}

double WeakRows::time(long row) const {
  return trajectory_.time(FirstSample(cells_[row]) + steps_ - steps_ / 2);
}

// A run of samples that lie in one cell.
struct WeakRows::Piece {
  long cell, within;  // the first one's place in the cell
  int place, length;  // in scratch->P and D
};

struct WeakRows::Output {
  long begin, end;  // rows
  double* const* columns;
  long stride;
  std::vector<int> sizes;  // columns of each joint, with the right side
};

// Adds what samples in scratch->P and D contribute to the windows, cell by
// cell. Rounding depends on the order of a sum; in this one a row is the same
// bits whichever rows were evaluated with it.
void WeakRows::AddSamples(int first, int count, const Output& output,
                          RowScratch* scratch) const {
  for (int done = 0; done < count;) {
    const long sample = trajectory_.first_index + first + done;
    const int length =
        static_cast<int>(std::min<long>(count - done, hop_ - sample % hop_));
    for (size_t i = 0; i < output.sizes.size(); ++i) {
      AddPiece({sample / hop_, sample % hop_, done, length},
               static_cast<int>(i), output, scratch);
    }
    done += length;
  }
}

// Subtracts a piece's share of all windows that reach over its cell,
//   u_c = -sum_k (dphi/dt_k P_c(t_k) + phi_k D_c(t_k)) dt,
// for one joint: phases x columns products of the same samples, which are a
// small matrix product. The windows over a cell begin at it or at one of the
// phases - 1 cells before it.
void WeakRows::AddPiece(const Piece& piece, int joint, const Output& output,
                        RowScratch* scratch) const {
  const int size = output.sizes[joint];
  scratch->products.resize(size * phases_);
  double* const products = scratch->products.data();
  const JointColumns &P = scratch->P, &D = scratch->D;
  const simd::ColumnPair pairs[] = {
      {phi_.data() + piece.within, weight_stride_,
       D.column(joint, 0) + piece.place, D.stride()},
      {rate_.data() + piece.within, weight_stride_,
       P.column(joint, 0) + piece.place, P.stride()}};
  simd::BestKernels().inner_products_of_two(pairs, phases_, size,
                                            Padded(piece.length), products);
  const auto begin = cells_.begin() + output.begin;
  const auto end = cells_.begin() + output.end;
  const auto first = std::lower_bound(begin, end, piece.cell - phases_ + 1);
  const auto last = std::upper_bound(first, end, piece.cell);
  double* row = output.columns[joint] + (first - begin);
  if (last - first == phases_) {  // no gap between them
    for (int c = 0; c < size; ++c, row += output.stride) {
      const double* of_column = products + c * phases_;
      for (int k = 0; k < phases_; ++k) row[k] -= of_column[k];
    }
    return;
  }
  for (auto w = first; w < last; ++w, ++row) {
    const long at = *w - (piece.cell - phases_ + 1);
    for (int c = 0; c < size; ++c) {
      row[c * output.stride] -= products[c * phases_ + at];
    }
  }
}

// Goes through the cells of the wanted rows once. The right side is made a
// column like any other: with P = 0 and D = -tau the same sum gives +int phi
// tau.
void WeakRows::Evaluate(long begin, long count, double* const* out, long stride,
                        RowScratch* scratch) const {
  if (count == 0) return;
  const Output output = {begin, begin + count, out, stride,
                         RowSizes(functions_, 1)};
  const int n = static_cast<int>(output.sizes.size());
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < output.sizes[i]; ++c) {
      std::fill_n(out[i] + c * stride, count, 0.0);
    }
  }
  scratch->P.Resize(output.sizes, kBatch);
  scratch->D.Resize(output.sizes, kBatch);
  const long end = cells_[begin + count - 1] + phases_;
  const long together = std::max(1L, kBatch / hop_);
  long row = begin;
  for (long cell = cells_[begin]; cell < end;) {
    while (cells_[row] + phases_ <= cell) ++row;
    cell = std::max(cell, cells_[row]);  // there may be a gap
    const long next = std::min(cell + together, end);
    const int last = std::min(FirstSample(next), trajectory_.size());
    for (int first = FirstSample(cell); first < last; first += kBatch) {
      const int samples = std::min(kBatch, last - first);
      functions_.Momentum(first, samples, scratch->P.data(), scratch->D.data(),
                          scratch->D.stride());
      for (int i = 0; i < n; ++i) {
        const double* const tau = trajectory_.tau.col(i).data() + first;
        const int last_column = output.sizes[i] - 1;
        std::transform(tau, tau + samples, scratch->D.column(i, last_column),
                       std::negate<>());
        std::fill_n(scratch->P.column(i, last_column), samples, 0.0);
      }
      AddSamples(first, samples, output, scratch);
    }
    cell = next;
  }
}

}  // namespace armcal
