#include "calib/numerics/robust_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "problems/robust_loss.h"

namespace armcal {
namespace {

// Bins of 0.5 % from 1e-12 to 1e12.
constexpr double kLow = 1e-12;
const double kLogStep = std::log(1.005);
constexpr int kEdges = 11100;

// Where a number's bin is, without its logarithm: numbers that share their
// exponent and the first bits of their mantissa are within half a bin, so that
// one or two neighbours are left.
class BinSearch {
 public:
  BinSearch() : edge_(kEdges + 1) {
    for (int b = 0; b <= kEdges; ++b) edge_[b] = kLow * std::exp(b * kLogStep);
    int bin = 0;
    for (std::uint64_t bits = First(kLow); bits <= First(edge_[kEdges]);
         ++bits) {
      const double least = FromFirst(bits);
      while (bin + 1 < kEdges && edge_[bin + 1] <= least) ++bin;
      bin_.push_back(bin);
    }
  }
  int operator()(double size) const {
    if (size <= kLow) return 0;
    if (!(size < edge_[kEdges])) return kEdges - 1;  // also NaN
    int bin = bin_[First(size) - First(kLow)];
    while (size >= edge_[bin + 1]) ++bin;
    return bin;
  }

 private:
  static constexpr int kOtherBits = 52 - 9;
  static std::uint64_t First(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    return bits >> kOtherBits;
  }
  static double FromFirst(std::uint64_t first) {
    const std::uint64_t bits = first << kOtherBits;
    double x;
    std::memcpy(&x, &bits, sizeof(x));
    return x;
  }

  std::vector<double> edge_;  // of each bin, and the last one's end
  std::vector<int> bin_;      // of the least number with these first bits
};

int BinOf(double size) {
  static const BinSearch search;
  return search(size);
}

}  // namespace

double Clipped(double r) {
  static const double bend = LossScale(RobustLoss::kHuber);
  return std::clamp(r, -bend, bend);
}

ResidualSpread::ResidualSpread() : histogram_(kEdges, 0) {}

void ResidualSpread::Add(double r) {
  ++histogram_[BinOf(std::abs(r))];
  ++count_;
}

double ResidualSpread::Value() const {
  long seen = 0;
  for (int b = 0; b < kEdges; ++b) {
    seen += histogram_[b];
    if (2 * seen >= count_ && count_ > 0) {
      return 1.4826 * kLow * std::exp((b + 0.5) * kLogStep);
    }
  }
  return 0;
}

ResidualStatistics::ResidualStatistics(int lag) : recent_(std::max(1, lag)) {}

void ResidualStatistics::Add(double r) {
  spread_.Add(r);
  const double clipped = Clipped(r);
  if (std::abs(clipped) < 0.5 * std::abs(r)) ++outliers_;
  square_ += clipped * clipped;
  if (num_recent_ < recent_.size()) {
    recent_[num_recent_++] = clipped;
    return;
  }
  product_ += clipped * recent_[oldest_];
  recent_[oldest_] = clipped;
  oldest_ = oldest_ + 1 < recent_.size() ? oldest_ + 1 : 0;
}

void ResidualStatistics::Break() { num_recent_ = oldest_ = 0; }

double ResidualStatistics::Autocorrelation() const {
  return square_ > 0 ? product_ / square_ : 0;
}

}  // namespace armcal
