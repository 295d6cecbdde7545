#include "calib/poses/correction/correction_table.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "calib/numerics/median.h"
#include "calib/poses/correction/joint_correction.h"
#include "model/robot/kinematics.h"
#include "model/text/format.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixX2d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Postures in which errors are measured: the largest of them is exceeded in one
// posture of a thousand.
constexpr int kPostures = 1000;
// Postures in which the bend of a correction is measured, and the share of a
// joint's range over which it is.
constexpr int kBendPostures = 60;
constexpr double kBendShare = .25;

class RandomPostures {
 public:
  explicit RandomPostures(const MatrixX2d& range) : range_(range) {}
  VectorXd Next() {
    VectorXd q(range_.rows());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      q[i] = range_(i, 0) + share_(random_) * (range_(i, 1) - range_(i, 0));
    }
    return q;
  }

 private:
  const MatrixX2d& range_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> share_{0, 1};
};

// Where the tool ends up, m, from both corrections' own point of view.
double CommandMiss(const ActualArm& arm, const VectorXd& q,
                   const VectorXd& correction) {
  return (arm.ToolPose(q + correction).translation() -
          ToolPose(arm.file(), q).translation())
      .norm();
}

double ForwardMiss(const ActualArm& arm, const VectorXd& q,
                   const VectorXd& correction) {
  return (ToolPose(arm.file(), q + correction).translation() -
          arm.ToolPose(q).translation())
      .norm();
}

// By joint, how far the correction in the middle of a stretch of kBendShare of
// its range is from the mean of its ends (median over postures, as a movement
// of the tool): linear interpolation over a stretch of length h misses by
// h^2 / 8 of the second derivative.
VectorXd Bends(const ActualArm& arm, const MatrixX2d& range) {
  const auto n = range.rows();
  MatrixXd bends(n, kBendPostures);
  RandomPostures postures(range);
  for (int k = 0; k < kBendPostures; ++k) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double half = .5 * kBendShare * (range(i, 1) - range(i, 0));
      VectorXd q = postures.Next();
      q[i] = std::clamp(q[i], range(i, 0) + half, range(i, 1) - half);
      VectorXd low = q, high = q;
      low[i] -= half;
      high[i] += half;
      const VectorXd mean =
          .5 * (ForwardCorrection(arm, low) + ForwardCorrection(arm, high));
      bends(i, k) = ForwardMiss(arm, q, mean);
    }
  }
  VectorXd median(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const VectorXd own = bends.row(i);
    median[i] = Median({own.begin(), own.end()});
  }
  return median;
}

// Nodes per joint: one more each time where it lowers the sum of the errors
// most for the rows that it costs (in logarithms).
std::vector<int> NodeCounts(const VectorXd& bends, const MatrixX2d& range,
                            long most_rows) {
  std::vector<int> nodes(bends.size());
  for (Eigen::Index i = 0; i < bends.size(); ++i) {
    nodes[i] = range(i, 1) > range(i, 0) ? 2 : 1;
  }
  const auto error = [&](Eigen::Index i, int count) {
    const double stretch = 1.0 / (count - 1) / kBendShare;
    return bends[i] * stretch * stretch;
  };
  for (;;) {
    long rows = 1;
    for (const int count : nodes) rows *= count;
    Eigen::Index best = -1;
    double most = 0;
    for (Eigen::Index i = 0; i < bends.size(); ++i) {
      const int count = nodes[i];
      if (count < 2 || rows / count * (count + 1) > most_rows) continue;
      const double gain = (error(i, count) - error(i, count + 1)) /
                          std::log((count + 1.0) / count);
      if (gain > most) {
        most = gain;
        best = i;
      }
    }
    if (best < 0) return nodes;
    ++nodes[best];
  }
}

CorrectionError ErrorOf(const VectorXd& distances) {
  const std::vector<double> all(distances.begin(), distances.end());
  return {Median(all), Quantile(all, .95), distances.maxCoeff()};
}

// Distances of points that are left after the best rigid motion of the first
// (Umeyama 1991).
VectorXd AlignedDistances(const Matrix3Xd& from, const Matrix3Xd& to) {
  const Isometry3d X(Eigen::umeyama(from, to, false));
  return ((X * from).eval() - to).colwise().norm();
}

}  // namespace

VectorXd CorrectionTable::At(long row) const {
  VectorXd q(static_cast<Eigen::Index>(nodes.size()));
  for (auto i = static_cast<Eigen::Index>(nodes.size()) - 1; i >= 0; --i) {
    q[i] = nodes[i][row % nodes[i].size()];
    row /= nodes[i].size();
  }
  return q;
}

VectorXd CorrectionTable::Interpolate(const MatrixXd& values,
                                      const VectorXd& q) const {
  const auto n = static_cast<int>(nodes.size());
  std::vector<long> low(n, 0);
  VectorXd share = VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    const VectorXd& at = nodes[i];
    if (at.size() == 1) continue;
    const double step = at[1] - at[0];
    const double x = std::clamp((q[i] - at[0]) / step, 0.0, at.size() - 1.0);
    low[i] = std::min<long>(static_cast<long>(x), at.size() - 2);
    share[i] = x - static_cast<double>(low[i]);
  }
  VectorXd sum = VectorXd::Zero(values.cols());
  for (int corner = 0; corner < 1 << n; ++corner) {
    double weight = 1;
    long row = 0;
    for (int i = 0; i < n; ++i) {
      const int up = corner >> i & 1;
      weight *= up != 0 ? share[i] : 1 - share[i];
      row = row * nodes[i].size() + low[i] + up;
    }
    if (weight > 0) sum += weight * values.row(row).transpose();
  }
  return sum;
}

CorrectionTable MakeCorrectionTable(const ActualArm& arm,
                                    const MatrixX2d& range, long most_rows) {
  CorrectionTable table;
  const std::vector<int> counts =
      NodeCounts(Bends(arm, range), range, most_rows);
  long rows = 1;
  for (size_t i = 0; i < counts.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    table.nodes.push_back(
        VectorXd::LinSpaced(counts[i], range(joint, 0), range(joint, 1)));
    rows *= counts[i];
  }
  table.forward.resize(rows, arm.num_joints());
  table.command.resize(rows, arm.num_joints());
  for (long row = 0; row < rows; ++row) {
    const VectorXd q = table.At(row);
    table.forward.row(row) = ForwardCorrection(arm, q);
    table.command.row(row) = CommandCorrection(arm, q);
  }
  return table;
}

CorrectionErrors MeasureCorrection(const ActualArm& arm,
                                   const CorrectionTable& table,
                                   const MatrixX2d& range) {
  VectorXd command(kPostures), by_table(kPostures), forward(kPostures);
  Matrix3Xd said(3, kPostures), is(3, kPostures);
  RandomPostures postures(range);
  for (int k = 0; k < kPostures; ++k) {
    const VectorXd q = postures.Next();
    said.col(k) = ToolPose(arm.file(), q).translation();
    is.col(k) = arm.ToolPose(q).translation();
    command[k] = CommandMiss(arm, q, CommandCorrection(arm, q));
    by_table[k] = CommandMiss(arm, q, table.Interpolate(table.command, q));
    forward[k] = ForwardMiss(arm, q, table.Interpolate(table.forward, q));
  }
  return {ErrorOf(AlignedDistances(said, is)), ErrorOf(command),
          ErrorOf(by_table), ErrorOf(forward)};
}

std::string CorrectionCsv(const ActualArm& arm, const CorrectionTable& table) {
  std::string text;
  for (const char* what : {"", "forward_", "command_"}) {
    for (const std::string& joint : arm.file().JointNames()) {
      text += (text.empty() ? "" : ",") + std::string(what) + joint;
    }
  }
  text += "\n";
  for (long row = 0; row < table.size(); ++row) {
    VectorXd all(3 * arm.num_joints());
    all << table.At(row), table.forward.row(row).transpose(),
        table.command.row(row).transpose();
    for (Eigen::Index k = 0; k < all.size(); ++k) {
      text += (k > 0 ? "," : "") + Format("%.7g", all[k]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace armcal
