#include "tests/blind/oracle_gap.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd MeanSquares(const MatrixXd& x) {
  return x.colwise().squaredNorm().transpose() / x.rows();
}

}  // namespace

double OracleGap::RemovedPercent() const {
  return 100 * (1 - (after.cwiseQuotient(floor)).sum() /
                        refit.cwiseQuotient(floor).sum());
}

double OracleGap::RemovedFromNominalPercent() const {
  return 100 * (1 - (after.cwiseQuotient(floor)).sum() /
                        nominal.cwiseQuotient(floor).sum());
}

std::optional<OracleGap> FindOracleGap(const BlindCase& blind,
                                       EffectSizer* sizer) {
  QuietRuns validation(blind, BlindLog::kValidation);
  const MatrixXd* with = validation.Residual(blind.effects);
  const MatrixXd* without = validation.Residual({});
  QuietRuns* training = sizer->training();
  const MatrixXd* trained = training->Residual(blind.effects);
  if (!with || !without || !trained) return std::nullopt;
  // Fitted to the errors of the file and the effects alone: what filters make
  // of friction near standstill is left to the validation.
  const MatrixXd error = FileError(blind, training->Motion());
  const MatrixXd columns = AbsorbingColumns(blind, validation.Motion());
  const auto left = [&](const MatrixXd& target, const MatrixXd& residual) {
    const CaseNoise& noise = sizer->noise();
    const VectorXd torque =
        columns * noise.absorption().Coefficients(noise.White(target),
                                                  noise.known_gradient());
    return MatrixXd(residual - Eigen::Map<const MatrixXd>(torque.data(),
                                                          residual.rows(),
                                                          residual.cols()));
  };
  OracleGap gap;
  gap.nominal = MeanSquares(*with);
  gap.refit =
      MeanSquares(left(error + *trained - *training->Residual({}), *with));
  gap.after = MeanSquares(left(error, *without));
  gap.floor = sizer->noise().floor();
  return gap;
}

}  // namespace armcal
