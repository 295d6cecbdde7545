#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/log_files/kept_log.h"
#include "model/log_files/time_base.h"
#include "model/signals/torque_samples.h"

namespace armcal {

// What is compared of torques reaches up to so many times the bandwidth.
inline constexpr double kTorqueBand = 4;

// A stretch of motion on a uniform time grid, samples in rows. Its core is the
// part that belongs to no other stretch; what lies around it lets filters and
// test functions reach across the border. A log sampled faster than 16 times
// the bandwidth is thinned to that rate, after its torque was low-passed at
// kTorqueBand times the bandwidth.
struct Trajectory {
  double t0 = 0;        // s since the log's first row, time of row 0
  double dt = 0;        // s
  Eigen::MatrixXd q;    // rad or m; low-passed unless the bandwidth is 0
  Eigen::MatrixXd qd;   // rad/s or m/s
  Eigen::MatrixXd qdd;  // rad/s^2 or m/s^2
  // The motion that friction changes sign with, low-passed as
  // TrajectoryOptions::friction has it; empty: q and qd.
  Eigen::MatrixXd friction_q, friction_qd;
  Eigen::MatrixXd tau;  // N m or N, up to kTorqueBand, without outliers
  Eigen::MatrixXd tau_recorded;  // the same with its outliers
  Eigen::MatrixXd temperature;   // deg C; empty: not recorded, or not wanted
  // Log::wrench (N, N m), low-passed as q is; empty: not recorded, not wanted.
  Eigen::MatrixXd wrench;
  // Log::current (A), as `tau_recorded` is; empty: not recorded, not wanted.
  Eigen::MatrixXd current;
  // All |qd| below 1e-3 rad/s (m/s) for 0.5 s or longer; qd here is the mean
  // over 0.2 s of positions low-passed at kTorqueBand times the bandwidth,
  // which rings less after a stop than `qd`.
  Eigen::Array<bool, Eigen::Dynamic, 1> standstill;
  // Per joint, samples of the core whose torque was a spike (spikes.h) and was
  // replaced; empty where spikes are not looked for.
  Eigen::Array<long, 1, Eigen::Dynamic> spikes;
  // The same of recorded positions (position_spikes.h), where they were first
  // met; empty where data are taken as they are.
  Eigen::Array<long, 1, Eigen::Dynamic> position_spikes;
  TorqueSamples samples;  // of all rows, where every sample is asked for
  // Whether the torque of a row is one of a time about it, as it was low-passed
  // and thinned, and not of an instant.
  bool thinned = false;
  int segment = 0;       // which stretch between gaps, from 0
  long first_index = 0;  // grid index of row 0 in its segment
  int core_begin = 0;
  int core_end = 0;

  int size() const { return static_cast<int>(q.rows()); }
  int num_joints() const { return static_cast<int>(q.cols()); }
  double time(int row) const { return t0 + row * dt; }
};

// What its numbers take.
std::size_t BytesOf(const Trajectory& trajectory);

// Cutoffs, Hz, of the motion that friction changes sign with.
struct FrictionBand {
  double position_hz, velocity_hz;
};

struct TrajectoryOptions {
  // Cutoff of the zero-phase low pass on positions, Hz. 0: data are taken as
  // they are, recorded velocities and accelerations where the log has them.
  double bandwidth_hz = 0;
  std::optional<FrictionBand> friction;
  TimeRange crop;
  // How far rows reach beyond the sample they belong to, s.
  double reach_s = 0;
  // Gross errors in torque samples: those of this list (the log's, by row) are
  // replaced; without one, spikes as RemoveSpikes finds them, unless the
  // bandwidth is 0.
  const std::vector<TorqueOutlier>* outliers = nullptr;
  bool remove_spikes = true;
  // The longest step between samples that is interpolated, s; 0: three steps,
  // or a quarter period of the bandwidth where that is longer.
  double longest_gap_s = 0;
  // No thinning, and the torque also sample by sample.
  bool every_sample = false;
};

// Cuts a log into trajectories of bounded length, so that a log of any length
// needs the same memory. A gap longer than longest_gap_s ends a segment;
// shorter ones are interpolated.
class TrajectoryReader {
 public:
  // `log` must outlive it, be at its first row and hold recorded velocities and
  // accelerations where options take them; `time_base` is the log's, of
  // AuditTimeBase.
  TrajectoryReader(KeptLog* log, const TimeBase& time_base,
                   const TrajectoryOptions& options);
  ~TrajectoryReader();
  TrajectoryReader(TrajectoryReader&&) noexcept;

  // The next stretch; false at the end.
  bool Next(Trajectory* trajectory);
  void Rewind();
  // The share of the log that Next() has passed, 0 to 1.
  double progress() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armcal
