#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/log_files/log.h"

namespace armcal {

// A torque sample that is wrong beyond noise, and what stands for it.
struct TorqueOutlier {
  long row;            // line of the log's file, the header is 1
  double time;         // s since the log's first row
  int joint;           // from 0
  double recorded;     // N m or N
  double replacement;  // N m or N: what the model predicts
  double size;         // of the jump from the samples around, in noise units

  friend bool operator==(const TorqueOutlier& a, const TorqueOutlier& b) {
    return a.row == b.row && a.time == b.time && a.joint == b.joint &&
           a.recorded == b.recorded && a.replacement == b.replacement &&
           a.size == b.size;
  }
};

// Torque as it was sampled, before anything is put on a time grid.
struct TorqueSamples {
  std::vector<long> row;  // lines of the file
  Eigen::VectorXd t;      // s since the log's first row
  Eigen::VectorXd place;  // on the grid of a trajectory, its row 0 is 0
  Eigen::MatrixXd tau;    // samples in rows

  int size() const { return static_cast<int>(t.size()); }
};

// The samples that a sliding window over one segment of a log holds.
class TorqueSampleWindow {
 public:
  TorqueSampleWindow(double dt, bool uniform) : dt_(dt), uniform_(uniform) {}

  void Clear();
  void Append(const Log& block, int row, int count = 1);
  // Forgets those before grid point `index` of the segment.
  void DropBefore(long index);
  // Those within grid points [begin, end).
  TorqueSamples Between(long begin, long end) const;

 private:
  // The first sample at or after grid point `index`.
  long At(long index) const;

  double dt_;
  bool uniform_;
  double begin_ = 0;
  long appended_ = 0;
  std::vector<long> rows_;
  std::vector<double> times_;
  std::vector<double> places_;  // on the segment's grid
  std::vector<std::vector<double>> tau_;
};

// Puts the replacements in place of what was recorded. `outliers` are one
// log's, in the order of its rows.
void ReplaceOutliers(const std::vector<TorqueOutlier>& outliers, Log* block);

}  // namespace armcal
