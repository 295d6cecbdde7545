#include "calib/drive_trains/samples.h"

#include <algorithm>
#include <cmath>

#include "calib/logs/thinned_samples.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

using OfWidths = std::array<MatrixXd, kSignWidths.size()>;

// The mean of each column `rows` before and after, at its ends of what there
// is.
MatrixXd Beside(const MatrixXd& x, Eigen::Index rows) {
  MatrixXd beside(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    beside.row(k) = (x.row(std::max<Eigen::Index>(0, k - rows)) +
                     x.row(std::min(x.rows() - 1, k + rows))) /
                    2;
  }
  return beside;
}

MatrixXd ColumnsOfJoints(const OfWidths& signals, int row) {
  MatrixXd columns(signals[0].cols(), kSignWidths.size());
  for (size_t w = 0; w < kSignWidths.size(); ++w) {
    columns.col(static_cast<Eigen::Index>(w)) = signals[w].row(row).transpose();
  }
  return columns;
}

// A trajectory's signals at the bandwidth, rows for samples.
struct SmoothSignals {
  MatrixXd current, torque, torque_beside;
  OfWidths sign, loaded_sign, loaded_sign_beside;

  SmoothSignals(const Trajectory& t, double bandwidth_hz) {
    constexpr int kRowsApart = 2;  // of signals as recorded
    const auto smooth = [&](const MatrixXd& x) -> MatrixXd {
      return bandwidth_hz > 0 ? ZeroPhaseLowPass(x, 1 / t.dt, bandwidth_hz) : x;
    };
    const Eigen::Index apart =
        bandwidth_hz > 0 ? std::lround(1 / (bandwidth_hz * t.dt)) : kRowsApart;
    current = smooth(t.current);
    torque = smooth(t.tau);
    torque_beside = Beside(torque, apart);
    const MatrixXd& qd = t.friction_qd.size() > 0 ? t.friction_qd : t.qd;
    for (size_t w = 0; w < kSignWidths.size(); ++w) {
      const MatrixXd turns = (qd / kSignWidths[w]).array().tanh();
      const auto loaded = [&](const MatrixXd& tau) {
        return smooth(tau.cwiseAbs().cwiseProduct(turns));
      };
      sign[w] = smooth(turns);
      loaded_sign[w] = loaded(torque);
      loaded_sign_beside[w] = loaded(torque_beside);
    }
  }

  DriveTrainSample At(const Trajectory& t, int row) const {
    DriveTrainSample sample;
    sample.current = current.row(row).transpose();
    sample.torque = torque.row(row).transpose();
    sample.torque_beside = torque_beside.row(row).transpose();
    sample.qd = t.qd.row(row).transpose();
    sample.qdd = t.qdd.row(row).transpose();
    sample.sign = ColumnsOfJoints(sign, row);
    sample.loaded_sign = ColumnsOfJoints(loaded_sign, row);
    sample.loaded_sign_beside = ColumnsOfJoints(loaded_sign_beside, row);
    return sample;
  }
};

}  // namespace

std::vector<DriveTrainSample> GatherDriveTrains(const Progress& progress,
                                                const PreparedLogs& logs,
                                                long most) {
  const double bandwidth = logs.options().bandwidth_hz;
  ThinnedSamples<DriveTrainSample> samples(bandwidth, most);
  logs.ForEach("drive trains", progress, [&](int log, const Trajectory& t) {
    if (t.current.size() == 0 || t.tau.size() == 0) return;
    const SmoothSignals signals(t, bandwidth);
    samples.Visit(log, t, [&](int row) { return signals.At(t, row); });
  });
  return samples.Samples();
}

}  // namespace armcal
