#include "calib/force_torque/samples.h"

#include "calib/logs/thinned_samples.h"

namespace armcal {

std::vector<ForceTorqueSample> GatherForceTorque(const Robot& robot,
                                                 const Progress& progress,
                                                 const PreparedLogs& logs,
                                                 long most) {
  ThinnedSamples<ForceTorqueSample> samples(logs.options().bandwidth_hz, most);
  logs.ForEach(
      "force-torque sensor", progress, [&](int log, const Trajectory& t) {
        if (t.wrench.size() == 0) return;
        samples.Visit(log, t, [&](int k) {
          ForceTorqueSample sample;
          sample.t = t.time(k);
          sample.motion =
              LastLinkMotion(robot, t.q.row(k).transpose(),
                             t.qd.row(k).transpose(), t.qdd.row(k).transpose());
          sample.wrench = t.wrench.row(k).transpose();
          return sample;
        });
      });
  return samples.Samples();
}

}  // namespace armcal
