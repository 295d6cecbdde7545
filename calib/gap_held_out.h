#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/gap_confirmation.h"
#include "calib/gap_data.h"
#include "calib/gap_fit.h"
#include "calib/gap_shrink.h"

namespace armcal {

// Logs, or parts of logs, that nothing is chosen on.
class HeldOut {
 public:
  // `other_logs`: not of the logs that were fitted, so that what happened once
  // in those did not happen here.
  HeldOut(const GapFit& fit, std::vector<GapSegment> segments, LogPart part,
          bool other_logs);

  const GapRows& rows() const { return data_->rows(); }
  const std::vector<GapSegment>& segments() const {
    return data_->rows().segments();
  }
  // Squares over variances, thinned samples x n; NaN where a joint stands.
  Eigen::MatrixXd Squares(const std::vector<GapCandidate>& effects,
                          const Eigen::VectorXd& baseline) const;
  // Of the file's robot, the refitted one and the one with the effects.
  HeldOutSquares AllSquares() const;
  // By how much the k-th effect lowers the mean square, those of all given.
  double Gain(size_t k, double after) const;
  // Whether these data are what the k-th effect says.
  Confirmation ConfirmationOf(size_t k) const;

 private:
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
  // Over their standard deviations; NaN where a joint stands.
  Eigen::MatrixXd Deviations(const Eigen::MatrixXd& residual) const;

  const GapFit& fit_;
  bool other_logs_;
  std::unique_ptr<GapData> data_;
};

}  // namespace armcal
