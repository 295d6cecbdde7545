#include "calib/diagnose/select/reference_fit.h"

#include <numeric>
#include <vector>

#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Rounds of a fit and the noise that it leaves.
constexpr int kRounds = 3;
// A file may be far off, and what the prior of a few per cent around its values
// held there would pass for noise: to tell that, values are as uncertain as
// they are large, this times the trust in a file.
constexpr double kWide = 20;

// With the first `columns` of the baseline, those behind them held at 0, whose
// prior is so much wider.
VectorXd Refit(const GapData& data, int columns, double wide) {
  GapScreen screen = data.Screen(columns);
  if (wide != 1) {
    std::vector<int> all(columns);
    std::iota(all.begin(), all.end(), 0);
    screen.ScaleBaseline(all, wide);
  }
  screen.Factor();
  VectorXd x = VectorXd::Zero(data.num_columns());
  x.head(columns) =
      wide * screen.BaselineGiven(JointRows(data.rows().num_joints()));
  return x;
}

VectorXd FitFirstWithNoise(int columns, double wide, GapData* data) {
  data->SetNoise(WhiteNoise(data->residual()));
  VectorXd x = Refit(*data, columns, wide);
  for (int round = 0; round < kRounds; ++round) {
    data->SetNoise(WhiteNoise(Moving(data->rows(), data->ResidualWith(x))));
    x = Refit(*data, columns, wide);
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
  return FitFirstWithNoise(data->num_columns(), 1, data);
}

VectorXd FitModel(const GapBaseline& baseline, const GapData& data) {
  return Refit(data, baseline.num_model_columns(), 1);
}

VectorXd FitModelWithNoise(const GapBaseline& baseline, GapData* data) {
  return FitFirstWithNoise(baseline.num_model_columns(), kWide, data);
}

}  // namespace armcal
