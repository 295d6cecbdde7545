#include "calib/diagnose/select/reference_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Rounds of a fit and the noise that it leaves. Of a reference a few: its own
// values become the next prior's mean (FitReference). Of a log without one they
// end where nothing changes: what a prior's pull towards a file that is far off
// leaves falls by a factor from one to the next.
constexpr int kRounds = 3, kMostRounds = 20;
constexpr double kSigmaSettled = .01;  // of a standard deviation

// With the first `columns` of the baseline, those behind them held at 0.
VectorXd Refit(const GapData& data, int columns) {
  GapScreen screen = data.Screen(columns);
  screen.Factor();
  VectorXd x = VectorXd::Zero(data.num_columns());
  x.head(columns) = screen.BaselineGiven(JointRows(data.rows().num_joints()));
  return x;
}

double ChangeOfSigma(const std::vector<Autoregression>& before,
                     const std::vector<Autoregression>& after) {
  double most = 0;
  for (size_t j = 0; j < after.size(); ++j) {
    if (!(after[j].sigma > 0)) continue;
    most = std::max(most, std::abs(before[j].sigma / after[j].sigma - 1));
  }
  return most;
}

VectorXd FitFirstWithNoise(int columns, int rounds, GapData* data) {
  std::vector<Autoregression> noise = WhiteNoise(data->residual());
  data->SetNoise(noise);
  VectorXd x = Refit(*data, columns);
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Autoregression> before = std::move(noise);
    noise = WhiteNoise(Moving(data->rows(), data->ResidualWith(x)));
    data->SetNoise(noise);
    x = Refit(*data, columns);
    if (ChangeOfSigma(before, noise) < kSigmaSettled) break;
  }
  return x;
}

}  // namespace

MatrixXd Moving(const GapRows& rows, const MatrixXd& residual) {
  MatrixXd moving = MatrixXd::Zero(residual.rows(), residual.cols());
  for (int j = 0; j < residual.cols(); ++j) {
    for (const int k : rows.SampleOfRow(j)) moving(k, j) = residual(k, j);
  }
  return moving;
}

VectorXd FitWithNoise(GapData* data) {
  return FitFirstWithNoise(data->num_columns(), kRounds, data);
}

VectorXd FitModel(const GapBaseline& baseline, const GapData& data) {
  return Refit(data, baseline.num_model_columns());
}

VectorXd FitModelWithNoise(const GapBaseline& baseline, GapData* data) {
  return FitFirstWithNoise(baseline.num_model_columns(), kMostRounds, data);
}

}  // namespace armcal
