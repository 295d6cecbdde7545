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

// At most `count` states, evenly spread over all logs: one is due whenever
// `passed` samples have reached the next multiple of `step`.
std::vector<ArmState> LoggedStates(int count, const Progress& progress,
                                   const PreparedLogs& logs) {
  double samples = 0;
  for (const TimeBase& base : logs.time_bases()) samples += base.samples;
  const double step = std::max(1.0, samples / count);
  std::vector<ArmState> states;
  double passed = 0;  // samples of the grid, thinned ones counted as one
  logs.ForEach("states", progress, [&](int log, const Trajectory& t) {
    const double thinned = t.dt / logs.time_bases()[log].dt;
    for (int k = t.core_begin; k < t.core_end; ++k, passed += thinned) {
      const bool due = passed >= step * static_cast<double>(states.size());
      if (!due || static_cast<int>(states.size()) >= count) continue;
      states.push_back({t.q.row(k), t.qd.row(k), t.qdd.row(k)});
    }
  });
  return states;
}

}  // namespace armcal
