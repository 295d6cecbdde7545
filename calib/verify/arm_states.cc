#include "calib/verify/arm_states.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

double Uniform(std::mt19937_64* random, double low, double high) {
  const double u = UniformDraw(random);
  return low + (high - low) * u;
}

double FiniteOr(double value, double otherwise) {
  return std::isfinite(value) ? value : otherwise;
}

}  // namespace

EvenSamples::EvenSamples(int count, const PreparedLogs& logs)
    : count_(count), time_bases_(logs.time_bases()) {
  double samples = 0;
  for (const TimeBase& base : time_bases_) samples += base.samples;
  step_ = std::max(1.0, samples / count);
}

// One is due whenever the samples passed have reached the next multiple of the
// step; a row of a thinned trajectory counts as the samples it stands for.
std::vector<int> EvenSamples::In(int log, const Trajectory& t) {
  const double thinned = t.dt / time_bases_[log].dt;
  std::vector<int> rows;
  for (int k = t.core_begin; k < t.core_end; ++k, passed_ += thinned) {
    if (passed_ < step_ * chosen_ || chosen_ >= count_) continue;
    rows.push_back(k);
    ++chosen_;
  }
  return rows;
}

// States are uniform within the file's limits; where it has none, a turn, 2
// rad/s and 10 rad/s^2 (1 m, 0.5 m/s and 3 m/s^2).
std::vector<ArmState> RandomStates(const Robot& robot, int count,
                                   std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const int n = robot.num_joints();
  std::vector<ArmState> states;
  for (int k = 0; k < count; ++k) {
    ArmState state{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (int j = 0; j < n; ++j) {
      const Joint& joint = robot.links[j].joint;
      const bool turns = IsRotational(joint.type);
      const double range = turns ? M_PI : 1;
      state.q[j] = Uniform(&random, FiniteOr(joint.lower, -range),
                           FiniteOr(joint.upper, range));
      const double speed = FiniteOr(joint.velocity, turns ? 2 : 0.5);
      state.qd[j] = Uniform(&random, -speed, speed);
      const double acceleration = turns ? 10 : 3;
      state.qdd[j] = Uniform(&random, -acceleration, acceleration);
    }
    states.push_back(state);
  }
  return states;
}

std::vector<ArmState> LoggedStates(int count, const Progress& progress,
                                   const PreparedLogs& logs) {
  std::vector<ArmState> states;
  EvenSamples even(count, logs);
  logs.ForEach("states", progress, [&](int log, const Trajectory& t) {
    for (const int k : even.In(log, t)) {
      states.push_back({t.q.row(k), t.qd.row(k), t.qdd.row(k)});
    }
  });
  return states;
}

}  // namespace armcal
