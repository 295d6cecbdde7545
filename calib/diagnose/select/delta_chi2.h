#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// By how much chi^2 falls when a candidate is added to a set of columns S that
// is fitted with it: delta_chi2 given S.
class DeltaChi2Given {
 public:
  // Keeps `screen` and `candidates`.
  DeltaChi2Given(const GapScreen& screen,
                 const std::vector<GapCandidate>& candidates,
                 const std::vector<int>& S);

  // The screen's gradient, or what it would be for another residual, less what
  // S explains of it.
  Eigen::VectorXd Conditioned(const Eigen::VectorXd& gradient) const;
  // Of candidate i, `g` conditioned. Columns of which nothing is left to see
  // have no part in it, nor those that would have the wrong sign given others;
  // 0 where no sign is right.
  double Of(size_t i, const Eigen::VectorXd& g) const;

 private:
  // A candidate's columns given S, and which of them can be seen.
  struct Own {
    Eigen::MatrixXd G;
    std::vector<bool> used;
  };
  Own OwnOf(const GapCandidate& candidate) const;

  const GapScreen& screen_;
  const std::vector<GapCandidate>& candidates_;
  std::vector<int> S_;
  Eigen::LLT<Eigen::MatrixXd> factor_;  // of G_SS
  Eigen::MatrixXd half_;                // G_SS^-1/2 G_S.
  std::vector<Own> own_;                // of each candidate
};

}  // namespace armcal
