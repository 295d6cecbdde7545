#include "calib/diagnose/select/reference_fit.h"

#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Rounds of a fit and the noise that it leaves.
constexpr int kRounds = 3;

VectorXd Refit(const GapData& data) {
  GapScreen screen = data.Screen();
  screen.Factor();
  return screen.BaselineGiven(JointRows(data.rows().num_joints()));
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
  data->SetNoise(WhiteNoise(data->residual()));
  VectorXd x = Refit(*data);
  for (int round = 0; round < kRounds; ++round) {
    data->SetNoise(WhiteNoise(Moving(data->rows(), data->ResidualWith(x))));
    x = Refit(*data);
  }
  return x;
}

}  // namespace armcal
