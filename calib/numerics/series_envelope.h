#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Several signals over time in bounded memory, for drawing: the least and the
// largest value of each in bins of equally many samples, so that no spike is
// lost however long the log. With few samples every bin is one of them.
class SeriesEnvelope {
 public:
  struct Bin {
    double begin = 0, end = 0;  // s, of its first and last sample
    Eigen::VectorXd low, high;  // per signal
    bool follows = false;       // the bin before without a gap
    long samples = 0;
  };

  SeriesEnvelope(int num_signals, int most_bins);

  void Add(double t, const Eigen::VectorXd& values);
  void Break();  // the next sample does not follow the last
  int num_signals() const { return num_signals_; }
  const std::vector<Bin>& bins() const { return bins_; }

 private:
  void Halve();

  int num_signals_;
  size_t most_bins_;
  long samples_per_bin_ = 1;
  bool follows_ = false;
  std::vector<Bin> bins_;
};

}  // namespace armcal
