#include "calib/diagnose/judge/effect_gain.h"

#include <vector>

#include "calib/diagnose/judge/removed_share.h"
#include "calib/numerics/block_bootstrap.h"

namespace armcal {

EffectGain GainBetween(const Eigen::MatrixXd& without,
                       const Eigen::MatrixXd& with, std::uint64_t seed) {
  const SumsOverJoints gain = SumJoints(without.cwiseAbs2() - with.cwiseAbs2());
  const double count = gain.count.sum();
  EffectGain result;
  if (!(count > 0)) return result;
  result.value = gain.sum.sum() / count;
  result.expected = MeanSquare((without - with).cwiseAbs2());
  const auto size = static_cast<int>(gain.sum.size());
  const double correlated = CorrelationTime({gain.sum.begin(), gain.sum.end()});
  const BootstrapInterval interval =
      BlockBootstrap(size, BootstrapBlock(size, correlated), seed,
                     [&](const std::vector<int>& drawn) {
                       double sum = 0, samples = 0;
                       for (const int k : drawn) {
                         sum += gain.sum[k];
                         samples += gain.count[k];
                       }
                       return sum / samples;
                     });
  result.ci95[0] = interval.low;
  result.ci95[1] = interval.high;
  return result;
}

}  // namespace armcal
