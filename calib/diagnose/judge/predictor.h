#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// A fit as far as it predicts torques that it was not fitted to.
//
// Of its own logs these are folds. Values are fitted to the other folds, and so
// is a choice of effects: the effects themselves were chosen on all of the
// logs, and whether data that lack a fold would have chosen them too says how
// far that is chance (stability selection: Meinshausen and Buehlmann 2010).
class Predictor {
 public:
  // With the values of the fit itself, for other logs. Keeps `fit`.
  explicit Predictor(const GapFit& fit);
  // With the same model and effects, but values that are fitted to all of its
  // logs but this fold.
  // `contenders`: the fit's.
  Predictor(const GapFit& fit, int left_out,
            const std::vector<int>& contenders);

  // Takes over the fit's effects, which may be others than before. `around`:
  // TorquesAround them; empty: not yet worked out.
  void Follow(const std::vector<JointRows>& around);

  const GapRegression& regression() const {
    return own_ ? *own_ : fit_.regression();
  }
  const RefinedEffects& refined() const { return refined_; }
  // GapFit's: the model's values alone, without any effect and given the
  // refined ones.
  const Eigen::VectorXd& model_refit() const { return model_refit_; }
  const Eigen::VectorXd& model_after() const { return model_after_; }
  // Whether its own data chose one of these effects, each at its place. What
  // other logs are predicted by chose all of them.
  bool ChoseOneOf(const std::vector<PlacedEffect>& effects) const;
  Eigen::VectorXd ModelGiven(const std::vector<GapCandidate>& effects) const;
  Eigen::VectorXd BaselineGiven(const std::vector<GapCandidate>& effects) const;

 private:
  void Choose(const std::vector<int>& contenders);

  const GapFit& fit_;
  std::unique_ptr<GapRegression> own_;
  std::vector<GapCandidate> chosen_;  // on its own data
  RefinedEffects refined_;
  Eigen::VectorXd model_refit_, model_after_;
};

}  // namespace armcal
