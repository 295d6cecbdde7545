#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "tests/blind/absorbing_columns.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/model_residual.h"
#include "tests/blind/residual_noise.h"

namespace armcal {

// How visible an effect is, apart from any diagnosis: the share of its torque
// that re-estimating what the model has anyway (the robot's parameters within
// their prior, the width of friction's zero velocity, timing) cannot absorb,
// relative to the noise (the ENR of docs/theory.md, 4: sqrt(Delta / N), Delta
// the fall of chi squared, N samples of each joint at 25 Hz after a low pass at
// 10 Hz). The noise is that of the residual, from a run with noise and the same
// without, as an autoregression.
struct EffectSize {
  double enr = 0;
  Eigen::VectorXd joint_enr;  // its shares per joint, root sum square = enr
  double raw = 0;             // the same before anything is absorbed
};

// Of whitened torques of an effect, `joints` blocks one below the other.
EffectSize SizeOf(const Eigen::VectorXd& whitened, long joints,
                  const Absorption& absorption);

// What sizes of effects of one case have in common: the noise and what the
// model absorbs, both from the arm without effects.
class CaseNoise {
 public:
  // Simulates the training log without effects, quiet (which `training`
  // keeps) and with noise.
  CaseNoise(const BlindCase& blind, QuietRuns* training);

  // Each joint's block of stacked rows in units of its innovations.
  Eigen::MatrixXd Whitened(const Eigen::MatrixXd& stacked) const;
  // The same of samples x joints.
  Eigen::VectorXd White(const Eigen::MatrixXd& residual) const;
  const Absorption& absorption() const { return *absorption_; }
  // Mean square of the noise in each joint's residual, (N m)^2 or N^2.
  const Eigen::VectorXd& floor() const { return floor_; }
  // The coefficients of the absorbing columns that a reference log tells: its
  // information times the truth; zero where there is none.
  const Eigen::VectorXd& known_gradient() const { return known_gradient_; }

 private:
  void Know(const BlindCase& blind);

  std::vector<ResidualNoise> noise_;
  Eigen::VectorXd floor_, known_gradient_;
  Eigen::MatrixXd known_;
  std::unique_ptr<Absorption> absorption_;
};

// Measures effects of a case from pairs of noiseless runs, one with all effects
// and one without that one. Refers to the case.
class EffectSizer {
 public:
  explicit EffectSizer(const BlindCase& blind);

  // Of the last effect beside the others. Nothing where the arm does not
  // follow its motion.
  std::optional<EffectSize> SizeOfLast(
      const std::vector<ChosenEffect>& effects);
  // Of each.
  std::optional<std::vector<EffectSize>> Sizes(
      const std::vector<ChosenEffect>& effects);

  const CaseNoise& noise() const { return *noise_; }
  QuietRuns* training() { return &training_; }

 private:
  QuietRuns training_;
  std::unique_ptr<CaseNoise> noise_;
};

// Of each effect of the case: the label of a case.
std::optional<std::vector<EffectSize>> EffectSizes(const BlindCase& blind);

}  // namespace armcal
