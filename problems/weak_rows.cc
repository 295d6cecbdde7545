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

// Those whose middle lies in the core.
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

// Samples of one cell.
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
// cell, so that sums do not depend on what was evaluated together.
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
