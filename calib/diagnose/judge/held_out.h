#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/judge/confirmation.h"
#include "calib/diagnose/judge/effect_gain.h"
#include "calib/diagnose/judge/predictor.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What a prediction leaves of torques, N m or N, with numbers in the place of
// what is not finite: where a law runs away outside of what it was fitted to
// (friction that grows as it warms a joint) what it leaves is kUnbounded, more
// than any robot has, and no sample that is missing.
inline constexpr double kUnbounded = 1e9;
Eigen::MatrixXd Bounded(const Eigen::MatrixXd& residual);

// Torques that are predicted by a model that was not fitted to them.
class HeldOut {
 public:
  // The fit's own logs, each fold (LogPart) predicted by a fit of its effects
  // to the others.
  explicit HeldOut(const GapFit& fit, std::uint64_t seed = 1);
  // Other logs: what happened once in those that were fitted did not happen
  // here.
  HeldOut(const GapFit& fit, std::vector<GapSegment> other_logs,
          std::uint64_t seed = 1);

  // Takes over the fit's effects again, which are others than before.
  void Follow();

  const GapRows& rows() const { return rows_->rows(); }
  const std::vector<GapSegment>& segments() const { return rows().segments(); }
  // One part of it with the model that predicts that: of other logs all of
  // them, else a fold.
  const GapRows& rows_of_part() const { return parts_.back().data->rows(); }
  const Predictor& predictor_of_part() const {
    return *parts_.back().predictor;
  }
  // Recorded minus predicted torque, thinned samples x n, N m or N: of the
  // file's robot (or the reference's), the refitted one and the one with the
  // effects.
  struct Residuals {
    Eigen::MatrixXd nominal, refit, after;
  };
  Residuals AllResiduals() const;
  HeldOutSquares SquaresOf(const Residuals& residuals) const;
  // Per joint the rms of nominal, refit and after, of the standard deviation
  // that what is held out has by noise and by what the model is not known for,
  // and of the recorded torque, over the samples in which it moves and that are
  // not masked: n x 5, N m or N; NaN where there are none, infinite where a
  // prediction is (Bounded).
  Eigen::MatrixXd RmsOf(const Residuals& residuals) const;
  // By how much the k-th effect given the others lowers the mean square.
  EffectGain GainOf(size_t k) const;
  // Whether these data are what the k-th effect says, given the others, part by
  // part. `alike`: it, and what may stand in its place.
  std::vector<Confirmation> ConfirmationsOf(
      size_t k, const std::vector<PlacedEffect>& alike) const;

 private:
  // What one model predicts.
  struct Part {
    std::unique_ptr<Predictor> predictor;
    std::unique_ptr<GapData> data;
    mutable std::unique_ptr<PredictedChi2> chi2;  // once it is asked for
  };
  void MaskEvents();
  std::vector<GapCandidate> InTheirPhase(
      const std::vector<GapCandidate>& effects, const Eigen::VectorXd& baseline,
      GapData* data) const;
  GapCandidate InPhase(const GapCandidate& effect, int log,
                       const Eigen::MatrixXd& residual, GapData* data) const;
  Eigen::MatrixXd ResidualOf(const std::vector<GapCandidate>& effects,
                             const Eigen::VectorXd& baseline,
                             GapData* data) const;
  // Thinned samples x n, N m or N.
  Eigen::MatrixXd Residual(const Part& part,
                           const std::vector<GapCandidate>& effects,
                           const Eigen::VectorXd& baseline) const;
  template <typename OfPart>
  Eigen::MatrixXd FromParts(const OfPart& of_part) const;
  static JointRows Whitened(const Part& part, const Eigen::MatrixXd& residual);
  static const PredictedChi2& Chi2Of(const Part& part);
  // Residuals::after.
  const Eigen::MatrixXd& After() const;
  // Over their standard deviations; NaN where a joint stands.
  Eigen::MatrixXd Deviations(const Eigen::MatrixXd& residual) const;

  const GapFit& fit_;
  std::uint64_t seed_;  // of the bootstrap
  bool other_logs_;
  std::vector<Part> parts_;
  std::unique_ptr<GapData> every_fold_;
  const GapData* rows_;            // whose rows are what any part has
  mutable Eigen::MatrixXd after_;  // what After() found; empty: not yet
};

}  // namespace armcal
