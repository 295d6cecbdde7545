#include "calib/inspect/inspection.h"

#include <algorithm>
#include <cmath>

#include "calib/inspect/frozen_findings.h"
#include "calib/inspect/held_out_fit.h"
#include "calib/inspect/inspected_series.h"
#include "calib/inspect/joint_zero.h"
#include "calib/inspect/jump_findings.h"
#include "calib/inspect/position_unit.h"
#include "calib/inspect/reading_text.h"
#include "calib/inspect/stuck_positions.h"
#include "calib/inspect/torque_unit.h"
#include "calib/inspect/unsigned_torque.h"
#include "calib/inspect/velocity_signs.h"
#include "calib/logs/clock_text.h"
#include "calib/logs/held_values.h"
#include "calib/logs/velocity_delay.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kSamples = 400;
constexpr int kLeastMoving = 60;

class Inspector {
 public:
  Inspector(const Robot& robot, const LogSource& log,
            const LogReaderOptions& options, int most_rows)
      : robot_(robot), result_(robot) {
    result_.path = log.name;
    LogReaderOptions wanted = options;
    wanted.want_velocity = wanted.commands_do = wanted.currents_do = true;
    LogReader reader(log, wanted);
    reader.Read(most_rows, &log_);
    Log more;
    result_.whole = !reader.Read(1, &more);
    result_.spelling = reader.spelling();
    result_.torque_source = reader.torque_source();
    result_.unscaled = reader.unscaled_drives();
    result_.rows = log_.size();
    torque_units_ = options.torque_constants;
    for (size_t j = 0;
         j < std::min(torque_units_.size(), options.gear_ratios.size()); ++j) {
      torque_units_[j] *= options.gear_ratios[j];
    }
    if (log_.size() < 3) {
      throw InputError(log.name, "", std::to_string(log_.size()) + " rows",
                       "expected at least 3");
    }
  }

  LogInspection Run(int drawn_bins) {
    result_.stamps = AuditStamps(log_);
    if (!(result_.stamps.mean_step > 0)) {
      throw InputError(result_.path, "", "all rows have the same time",
                       "expected stamps that rise");
    }
    log_.t = (result_.stamps.unit * (log_.t.array() - log_.t[0])).eval();
    if (drawn_bins > 0) result_.drawing = DrawLog(log_, drawn_bins);
    result_.jumps = FindPositionJumps(robot_, log_);
    MendJumps(result_.jumps, &log_);
    AddZerosLostAtRest(robot_, log_, &result_.jumps);
    result_.findings =
        AuditChannels(robot_, log_, result_.stamps, torque_units_);
    const auto held = AuditHeldValues(robot_, log_);
    result_.findings.insert(result_.findings.end(), held.begin(), held.end());
    AddUnscaled();
    AddVelocityDelays();
    AddClock();
    const auto jumps =
        JumpFindings(robot_, log_.t, result_.jumps, result_.clock.wrong());
    result_.findings.insert(result_.findings.begin(), jumps.begin(),
                            jumps.end());
    result_.duration = log_.t[log_.size() - 1];
    DescribeMotion();
    LeaveOutFrozen();
    const UniformSeries series = Series();
    DescribeSpeed(series);
    if (!CanAsk()) {
      result_.coverage.reason =
          "torques are not asked for signs, order, units and gravity while a "
          "column is zero, stuck or jumps";
    } else {
      ReadTorques(series);
    }
    if (result_.reading.units.any()) {
      TakeUnits();
    } else {
      SayOfAllVelocities(robot_, log_, &result_.findings);
    }
    return result_;
  }

 private:
  // What stands still or jumps for no reason would be explained by anything.
  bool CanAsk() const {
    if (log_.tau.size() == 0) return true;  // nothing is
    return std::none_of(result_.findings.begin(), result_.findings.end(),
                        [](const InspectionFinding& f) {
                          return (f.finding == "stuck" && !f.leads) ||
                                 f.finding == "no_torque" ||
                                 f.finding == "position_jump" ||
                                 f.finding == "missing_time";
                        });
  }

  // The cause before what follows from it, and the motion's figures in rad and
  // m.
  void TakeUnits() {
    const PositionUnits& units = result_.reading.units;
    result_.velocity_as_it_is =
        PutPositionUnitFirst(robot_, log_, units, &result_.findings);
    for (VectorXd* figure :
         {&result_.travel, &result_.top_speed, &result_.tracking_rms}) {
      for (int j = 0; j < figure->size(); ++j) {
        (*figure)[j] *= units.Of(robot_.links[j].joint, j);
      }
    }
  }

  void DescribeMotion() {
    result_.travel = log_.q.colwise().maxCoeff() - log_.q.colwise().minCoeff();
    if (log_.qref.size() == 0) return;
    result_.tracking_rms =
        (log_.qref - log_.q).colwise().norm() / std::sqrt(log_.size());
  }

  // Before anything is concluded from them. Of such a column nothing else is
  // said, but that it is at a limit where it is so in other rows, too.
  void LeaveOutFrozen() {
    result_.frozen = FindAllFrozenChannels(robot_, log_, result_.jumps,
                                           result_.stamps.mean_step);
    if (result_.frozen.empty()) return;
    const auto findings = FrozenFindings(robot_, log_.t, result_.frozen);
    log_ = WithoutFrozenRows(log_, result_.frozen);
    for (const FrozenChannel& run : result_.frozen) {
      const bool is_at_limit =
          !run.is_position &&
          (log_.tau.col(run.joint).array() == run.value).count() > 1;
      DropFindings(
          [&](const InspectionFinding& f) {
            return IsOf(run, f) && (f.finding == "stuck" ||
                                    (f.finding == "saturated" && !is_at_limit));
          },
          &result_.findings);
    }
    const bool any_position =
        std::any_of(result_.frozen.begin(), result_.frozen.end(),
                    [](const auto& run) { return run.is_position; });
    if (any_position) {
      DropVelocitiesOfFrozen(
          result_.frozen,
          AuditChannels(robot_, log_, result_.stamps, torque_units_),
          &result_.findings);
    }
    result_.findings.insert(result_.findings.begin(), findings.begin(),
                            findings.end());
  }

  UniformSeries Series() const {
    return InspectedSeries(log_, result_.stamps.mean_step);
  }

  // What a fit leaves of torques held out, read as they are.
  HeldOutFit HeldOut() const {
    return FitHeldOut(
        robot_, SamplesAs(LogReading(robot_), robot_, Series(), kSamples));
  }

  // The time that the joints tell is offered only where torques that are held
  // out fit better with it, or, without torques, where rows are not at the
  // stamps' times.
  void AddClock() {
    result_.clock = EstimateSampleClock(log_);
    const SampleClock& clock = result_.clock;
    if (!clock.wrong()) return;
    InspectionFinding finding{"clock", ClockSentence(clock),
                              ClockEvidence(clock),
                              "log each sample's own time"};
    bool better = clock.uneven;
    const Eigen::VectorXd stamps = log_.t;
    if (log_.tau.size() > 0 && Series().num_moving() >= kLeastMoving) {
      const HeldOutFit before = HeldOut();
      log_.t = clock.t;
      const HeldOutFit after = HeldOut();
      better = after.all[0] < before.all[0] && after.all[1] < before.all[1];
      finding.evidence += Format(
          "; of torques held out a fit leaves %.3g %% by the stamps and %.3g "
          "%% by that time",
          before.residual_percent, after.residual_percent);
      finding.held_out_before = before.residual_percent;
      finding.held_out_after = after.residual_percent;
    }
    result_.rebuilds_time = better;
    log_.t = better ? clock.t : stamps;
    if (better) {
      finding.remedy = OptionName("fix") + " writes the log with that time";
    }
    result_.findings.push_back(finding);
  }

  void DescribeSpeed(const UniformSeries& series) {
    result_.top_speed = series.motion().qd.cwiseAbs().colwise().maxCoeff();
    result_.moving_share = static_cast<double>(series.num_moving()) /
                           static_cast<double>(series.motion().size());
  }

  // An arm that moves, but never for long between two holes, needs no other
  // motion.
  static InspectionFinding NoMotion(const UniformSeries& series) {
    const double moving = series.num_moving() * series.dt();
    const double at_gaps = series.num_moving_at_gaps() * series.dt();
    if (series.num_moving() + series.num_moving_at_gaps() < kLeastMoving) {
      return {"no_motion", "the arm hardly moves",
              Format("%.2g s of motion", moving),
              "record a motion (armcal excite)"};
    }
    return {"no_motion",
            "the holes leave too little motion to ask torques for signs, "
            "order, units and gravity",
            Format("of %.3g s of motion %.2g s are farther than %.2g s from a "
                   "hole",
                   moving + at_gaps, moving, series.reach()),
            "log without losses"};
  }

  void ReadTorques(const UniformSeries& series) {
    if (series.num_moving() < kLeastMoving) {
      result_.findings.push_back(NoMotion(series));
      return;
    }
    if (log_.tau.size() == 0) {
      const UnscaledDrives& drives = result_.unscaled;
      result_.coverage.reason = drives.columns.empty()
                                    ? "no torque is logged"
                                    : "its " + drives.what + " (" +
                                          drives.columns + ") need " +
                                          OptionName("torque_constants");
      return;
    }
    ReadingFinding found =
        FindReading(robot_, series,
                    {Tells(), !result_.clock.wrong(),
                     HintsOfPositionUnit(robot_, log_, series.motion().qd)});
    const std::vector<bool> opposite = OppositeVelocities(log_);
    BelieveVelocities(opposite, &found);
    MergeTorqueSigns(&found.changes);
    DropTorqueUnit(&found.changes);
    result_.reading = found.reading;
    DropRightVelocities(opposite);
    result_.as_it_is = found.changes.empty() && !result_.clock.wrong() &&
                       result_.frozen.empty();
    result_.residual_percent = found.residual_percent;
    for (const ReadingChange& change : found.changes) {
      result_.findings.push_back(FindingOf(change, found.reading, robot_));
    }
    AddUnsigned(series);
    Robot robot = robot_;
    LogReading as_logged = found.reading;
    as_logged.torque_unit = 1;
    robot.gravity = as_logged.gravity;
    const WiringSamples samples =
        SamplesAs(as_logged, robot_, series, kSamples);
    result_.torque_scales = TorqueScale(robot, samples);
    // What is wrong with the log would be asked of the file's bodies, too.
    if (result_.as_it_is) {
      const auto zeros = DoubtJointZeros(robot, samples);
      result_.findings.insert(result_.findings.end(), zeros.begin(),
                              zeros.end());
    }
    const auto units = FindTorqueUnits(robot, samples, result_.torque_scales);
    result_.findings.insert(result_.findings.end(), units.begin(), units.end());
  }

  // The velocity of a position that is turned round is right, if it was
  // opposite, and follows from that.
  void DropRightVelocities(const std::vector<bool>& opposite) {
    const Wiring& wiring = result_.reading.wiring;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const int from = wiring.position_column[j];
      if (wiring.position_sign[j] > 0 || !opposite[from]) continue;
      DropFindings(
          [from](const InspectionFinding& f) {
            return f.joint == from && f.finding == "velocity";
          },
          &result_.findings);
    }
  }

  // Which joints' torques have the values to tell a sign by.
  std::vector<bool> Tells() const {
    std::vector<bool> tells(robot_.num_joints(), true);
    for (const InspectionFinding& f : result_.findings) {
      if (f.finding == "quantised") tells[f.joint] = false;
    }
    return tells;
  }

  // What scale currents or voltages have, no motion tells: twice the constants
  // and twice the inertias draw the same.
  void AddUnscaled() {
    const UnscaledDrives& drives = result_.unscaled;
    if (drives.columns.empty()) return;
    result_.findings.push_back(
        {"unscaled_" + drives.what,
         "motor " + drives.what +
             " are logged, and nothing says what torque they make",
         "columns " + drives.columns +
             "; nothing is asked of them, as no motion tells their scale",
         drives.wanted + " (armcal calibrate)"});
  }

  void AddVelocityDelays() {
    if (log_.qd.size() == 0) return;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const auto delay = VelocityDelay(log_, j);
      if (!delay) continue;
      result_.findings.push_back(
          {"velocity_delay",
           Format("the velocity of %s is recorded %.1f ms %s its position",
                  robot_.links[j].joint.name.c_str(), 1e3 * std::abs(*delay),
                  *delay > 0 ? "after" : "before"),
           "as the position changes in two halves of the log",
           "armcal differentiates positions; other tools should, too", j});
    }
  }

  void AddUnsigned(const UniformSeries& series) {
    std::vector<int> joints;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      const double low = log_.tau.col(j).minCoeff();
      const double high = log_.tau.col(j).maxCoeff();
      if (low < high && low * high >= 0) joints.push_back(j);
    }
    Robot robot = robot_;
    robot.gravity = result_.reading.gravity;
    const WiringSamples samples =
        SamplesAs(result_.reading, robot_, series, kSamples);
    for (const InspectionFinding& finding :
         UnsignedFindings(robot, series, log_, samples, joints)) {
      DropSigns(finding.joint);
      result_.findings.push_back(finding);
    }
  }

  // What has no sign had the wrong one in most samples, not in all.
  void DropSigns(int j) {
    DropFindings(
        [j](const InspectionFinding& f) {
          return f.joint == j &&
                 (f.finding == "torque_sign" || f.finding == "position_sign");
        },
        &result_.findings);
    result_.reading.wiring.torque_sign[j] = 1;
    result_.reading.wiring.position_sign[j] = 1;
  }

  const Robot& robot_;
  LogInspection result_;
  Log log_;
  std::vector<double> torque_units_;  // of currents or voltages, N m
};

}  // namespace

LogInspection InspectLog(const Robot& robot, const LogSource& log,
                         const LogReaderOptions& options, int drawn_bins,
                         int most_rows) {
  return Inspector(robot, log, options, most_rows).Run(drawn_bins);
}

Log Mended(const Robot& robot, const Log& recorded,
           const LogInspection& inspection) {
  Log log = recorded;
  MendJumps(inspection.jumps, &log);
  log.t = inspection.rebuilds_time ? inspection.clock.t
                                   : (inspection.stamps.unit * log.t).eval();
  const std::vector<bool> opposite = OppositeVelocities(log);
  Log mended = log;
  const LogReading& reading = inspection.reading;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const int from = reading.wiring.position_column[j];
    const double sign = reading.wiring.position_sign[j];
    const double unit = reading.units.Of(robot.links[j].joint, from);
    const bool as_it_is = !inspection.velocity_as_it_is.empty() &&
                          inspection.velocity_as_it_is[from];
    const double of_velocity = as_it_is ? 1 : unit;
    mended.q.col(j) = sign * unit * log.q.col(from);
    if (log.qd.size() > 0) {
      // One that is opposite to a position with the wrong sign is right.
      const double of_sign = opposite[from] ? 1 : sign;
      mended.qd.col(j) = of_sign * of_velocity * log.qd.col(from);
    }
    if (log.qref.size() > 0) {
      mended.qref.col(j) = sign * unit * log.qref.col(from);
    }
    if (log.tau.size() == 0) continue;
    mended.tau.col(j) = reading.wiring.torque_sign[j] *
                        log.tau.col(reading.wiring.torque_column[j]);
  }
  return WithoutFrozenRows(mended, inspection.frozen);
}

}  // namespace armcal
