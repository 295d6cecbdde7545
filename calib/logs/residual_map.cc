#include "calib/logs/residual_map.h"

namespace armcal {
namespace {

constexpr int kMostBins = 40;

}  // namespace

ResidualMap::ResidualMap(int num_models)
    : position(num_models, kMostBins),
      velocity(num_models, kMostBins),
      load(num_models, kMostBins),
      time(num_models, kMostBins) {}

void ResidualMap::Add(const At& at, const Eigen::VectorXd& residuals) {
  position.Add(at.position, residuals);
  velocity.Add(at.velocity, residuals);
  load.Add(at.load, residuals);
  time.Add(at.time, residuals);
}

}  // namespace armcal
