#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/judge/confirmation.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// Logs, or parts of logs, that nothing is chosen on.
class HeldOut {
 public:
  // LogPart::kHeldOut of the logs that were fitted.
  explicit HeldOut(const GapFit& fit);
  // Other logs: what happened once in those that were fitted did not happen
  // here.
  HeldOut(const GapFit& fit, std::vector<GapSegment> other_logs);

  const GapRows& rows() const { return data_->rows(); }
  const std::vector<GapSegment>& segments() const {
    return data_->rows().segments();
  }
  // Recorded minus predicted torque, thinned samples x n, N m or N: of the
  // file's robot (or the reference's), the refitted one and the one with the
  // effects.
  struct Residuals {
    Eigen::MatrixXd nominal, refit, after;
  };
  Residuals AllResiduals() const;
  HeldOutSquares SquaresOf(const Residuals& residuals) const;
  // What the k-th effect does given the others: by how much it lowers the mean
  // square, that of all being `after`, and whether these data are what it says.
  struct Merit {
    double gain = 0;
    Confirmation confirmation;
  };
  Merit MeritOf(size_t k, double after) const;

 private:
  void SetNoise();
  void MaskEvents();
  std::vector<GapCandidate> InTheirPhase(
      const std::vector<GapCandidate>& effects,
      const Eigen::VectorXd& baseline) const;
  GapCandidate InPhase(const GapCandidate& effect, int log,
                       const Eigen::MatrixXd& residual) const;
  Eigen::MatrixXd ResidualOf(const std::vector<GapCandidate>& effects,
                             const Eigen::VectorXd& baseline) const;
  // Thinned samples x n, N m or N.
  Eigen::MatrixXd Residual(const std::vector<GapCandidate>& effects,
                           const Eigen::VectorXd& baseline) const;
  JointRows Whitened(const Eigen::MatrixXd& residual) const;
  const PredictedChi2& chi2() const;
  // Over their standard deviations; NaN where a joint stands.
  Eigen::MatrixXd Deviations(const Eigen::MatrixXd& residual) const;

  const GapFit& fit_;
  bool other_logs_;
  std::unique_ptr<GapData> data_;
  mutable std::unique_ptr<PredictedChi2> chi2_;  // once it is asked for
};

}  // namespace armcal
