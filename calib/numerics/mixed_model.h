#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// What a log tells of the parameters x of the unit it was recorded on: the
// least-squares problem x' information x - 2 right' x, in units of its errors.
struct UnitEvidence {
  int unit = 0;     // 0 .. units - 1
  double time = 0;  // s
  Eigen::MatrixXd information;
  Eigen::VectorXd right;
};

// The mixed model x_u(t) = mean + drift (t - reference) + d_u, d_u ~ N(0, T)
// with a diagonal T, by restricted maximum likelihood: generalised least
// squares for the fixed effects mean and drift, for T the fixed point
// T_k = sum d_k^2 / sum (1 - Var(d_k | data) / T_k) (Harville 1977).
// In scaled parameters and times; unscaled = scale() * scaled.
class MixedModel {
 public:
  // A unit's logs together; with X = [1 t] of each log:
  struct Unit {
    Eigen::MatrixXd L, B, A;             // sums of information, X' L and X' L X
    Eigen::VectorXd right, fixed_right;  // sums of right and X' right
    double last = 0;                     // time of its last log
  };

  MixedModel(const std::vector<UnitEvidence>& evidence, int units, bool drift);

  // Without the units left out.
  void Fit(const std::vector<bool>& left_out);

  int size() const { return static_cast<int>(units_.size()); }
  int parameters() const { return static_cast<int>(scale_.size()); }
  const Unit& unit(int u) const { return units_[u]; }
  const Eigen::VectorXd& scale() const { return scale_; }
  double reference() const { return reference_; }    // s
  double time_scale() const { return time_scale_; }  // s
  bool has_drift() const { return drift_; }
  const Eigen::VectorXd& root() const { return root_; }  // of T's diagonal
  const Eigen::VectorXd& fixed() const { return fixed_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }  // of it
  // Which share of each fixed effect the data see.
  const Eigen::VectorXd& determined() const { return determined_; }
  // Var(d_u | fixed effects, data), also for another T.
  const Eigen::MatrixXd& posterior(int u) const { return posteriors_[u]; }
  Eigen::MatrixXd Posterior(int u, const Eigen::VectorXd& root) const;

 private:
  void SolveFixed(const std::vector<bool>& left_out);
  double UpdateSpread(const std::vector<bool>& left_out);

  Eigen::VectorXd scale_;
  double reference_ = 0, time_scale_ = 1;
  bool drift_;
  std::vector<Unit> units_;
  Eigen::VectorXd root_, fixed_, determined_;
  Eigen::MatrixXd covariance_;
  std::vector<Eigen::MatrixXd> posteriors_;
};

}  // namespace armcal
