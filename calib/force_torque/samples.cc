#include "calib/force_torque/samples.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// A sample and where it stands on the time grid of its segment.
struct PlacedSample {
  ForceTorqueSample sample;
  int segment = 0;
  long index = 0;
};

class ForceTorqueGatherer {
 public:
  ForceTorqueGatherer(const Robot& robot, double bandwidth_hz, long most)
      : robot_(robot), bandwidth_hz_(bandwidth_hz), most_(most) {}

  void Visit(int log, const Trajectory& t) {
    if (t.wrench.size() == 0) return;
    if (stride_ == 0) {
      stride_ = bandwidth_hz_ > 0
                    ? std::max(1L, std::lround(1 / (4 * bandwidth_hz_ * t.dt)))
                    : 1;
    }
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const long index = t.first_index + k;
      if (index % stride_ == 0) Add(log, t, k, index);
    }
  }

  std::vector<ForceTorqueSample> Samples() const {
    std::vector<ForceTorqueSample> samples;
    const PlacedSample* last = nullptr;
    for (const PlacedSample& placed : placed_) {
      samples.push_back(placed.sample);
      samples.back().follows = last != nullptr &&
                               last->sample.log == placed.sample.log &&
                               last->segment == placed.segment &&
                               placed.index - last->index == stride_;
      last = &placed;
    }
    return samples;
  }

 private:
  void Add(int log, const Trajectory& t, int k, long index) {
    PlacedSample placed;
    placed.segment = t.segment;
    placed.index = index;
    placed.sample.log = log;
    placed.sample.t = t.time(k);
    placed.sample.motion =
        LastLinkMotion(robot_, t.q.row(k).transpose(), t.qd.row(k).transpose(),
                       t.qdd.row(k).transpose());
    placed.sample.wrench = t.wrench.row(k).transpose();
    placed_.push_back(placed);
    if (static_cast<long>(placed_.size()) <= most_) return;
    stride_ *= 2;
    placed_.erase(std::remove_if(placed_.begin(), placed_.end(),
                                 [this](const PlacedSample& p) {
                                   return p.index % stride_ != 0;
                                 }),
                  placed_.end());
  }

  const Robot& robot_;
  double bandwidth_hz_;
  long most_;
  long stride_ = 0;  // 0: no sample was seen yet
  std::vector<PlacedSample> placed_;
};

}  // namespace

std::vector<ForceTorqueSample> GatherForceTorque(const Robot& robot,
                                                 const Progress& progress,
                                                 const PreparedLogs& logs,
                                                 long most) {
  ForceTorqueGatherer gatherer(robot, logs.options().bandwidth_hz, most);
  logs.ForEach("force-torque sensor", progress,
               [&](int log, const Trajectory& t) { gatherer.Visit(log, t); });
  return gatherer.Samples();
}

}  // namespace armcal
