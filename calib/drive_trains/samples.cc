#include "calib/drive_trains/samples.h"

#include "calib/logs/thinned_samples.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// A trajectory's signals at the bandwidth, rows for samples.
struct SmoothSignals {
  MatrixXd current, torque;
  std::array<MatrixXd, kSignWidths.size()> sign, loaded_sign;

  SmoothSignals(const Trajectory& t, double bandwidth_hz) {
    const auto smooth = [&](const MatrixXd& x) -> MatrixXd {
      return bandwidth_hz > 0 ? ZeroPhaseLowPass(x, 1 / t.dt, bandwidth_hz) : x;
    };
    current = smooth(t.current);
    torque = smooth(t.tau);
    const MatrixXd& qd = t.friction_qd.size() > 0 ? t.friction_qd : t.qd;
    for (size_t w = 0; w < kSignWidths.size(); ++w) {
      const MatrixXd turns = (qd / kSignWidths[w]).array().tanh();
      sign[w] = smooth(turns);
      loaded_sign[w] = smooth(torque.cwiseAbs().cwiseProduct(turns));
    }
  }

  DriveTrainSample At(const Trajectory& t, int row) const {
    DriveTrainSample sample;
    sample.current = current.row(row).transpose();
    sample.torque = torque.row(row).transpose();
    sample.qd = t.qd.row(row).transpose();
    sample.qdd = t.qdd.row(row).transpose();
    sample.sign.resize(t.num_joints(), kSignWidths.size());
    sample.loaded_sign = sample.sign;
    for (size_t w = 0; w < kSignWidths.size(); ++w) {
      const auto column = static_cast<Eigen::Index>(w);
      sample.sign.col(column) = sign[w].row(row).transpose();
      sample.loaded_sign.col(column) = loaded_sign[w].row(row).transpose();
    }
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
