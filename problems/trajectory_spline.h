#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// A uniform quintic B-spline over a stretch of samples: four times continuously
// differentiable, so that torques along it are smooth. Sample k is
// sum_a weights(d, a) c[first + a] for position (d = 0), velocity and
// acceleration.
class TrajectorySpline {
 public:
  static constexpr int kSupport = 6;  // control points that reach a sample
  struct Basis {
    int first;
    Eigen::Matrix<double, 3, kSupport> weights;  // 1, 1/s, 1/s^2
  };

  // Knots every `knot_s` seconds, a little more or less so that the stretch
  // holds a whole number of intervals, and at least three samples apart.
  TrajectorySpline(int samples, double dt, double knot_s);
  // The fewest samples that a spline can be fitted to.
  static constexpr int kLeastSamples = 3 * kSupport;

  int size() const { return static_cast<int>(basis_.size()); }
  int num_points() const { return intervals_ + kSupport - 1; }
  double knot_s() const { return knot_s_; }
  const Basis& basis(int sample) const { return basis_[sample]; }

  // Derivative `order` of the spline with control points in rows (num_points x
  // n) at all samples: size() x n.
  Eigen::MatrixXd Evaluate(const Eigen::MatrixXd& points, int order) const;
  // The control points that come nearest to samples (size() x n).
  Eigen::MatrixXd Fit(const Eigen::MatrixXd& samples) const;

 private:
  int intervals_;
  double knot_s_;
  std::vector<Basis> basis_;
};

}  // namespace armcal
