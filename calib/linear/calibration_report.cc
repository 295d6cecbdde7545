#include "calib/linear/calibration_report.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/calibration_warnings.h"
#include "calib/linear/outlier_report.h"
#include "calib/linear/verdict.h"
#include "calib/numerics/readable_sum.h"
#include "model/log_files/torque_columns.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

std::string Percent(double percent) {
  return std::isfinite(percent) ? Format("%7.2f", percent) : "      -";
}

std::string PlusMinus(double value, double stddev) {
  // Any value would do as well as the one that the solver has.
  if (!std::isfinite(stddev)) return Format("%11s (not seen)  ", "-");
  return Format("%11.5g +- %-9.3g", value, stddev);
}

const char* IdentificationName(const LinearCalibration& result) {
  switch (result.rows.identification) {
    case Identification::kWeak:
      return "weak form";
    case Identification::kDifferential:
      return "differential model (2.19)";
    case Identification::kIntegral:
      return "integral model (2.27)";
  }
  return "";
}

// Says what the result is of: the logs, the torque's source, and the equations.
std::string DataText(const LogSet& training, const LinearCalibration& result) {
  std::string text;
  for (int k = 0; k < training.size(); ++k) {
    text += "log        " + training.path(k) + ": " +
            training.time_bases()[k].Describe() + "\n";
  }
  text += "torque     " + training.torque_source() + "; " +
          ScaleText(training.torque_constants_stddev()) + "\n";
  text += "equations  " + std::string(IdentificationName(result));
  if (result.rows.identification == Identification::kWeak) {
    text += Format(", windows of %.3g s", result.rows.window_s);
  }
  text += Format(", %ld per joint", result.equations);
  text += result.rows.bandwidth_hz > 0
              ? Format("; bandwidth %.3g Hz", result.rows.bandwidth_hz)
              : std::string("; no filter");
  if (result.training && result.training->excluded_share() > 0) {
    text += Format("; standstill left out: %.1f %% of the samples",
                   100 * result.training->excluded_share());
  }
  return text + "\n";
}

// Torque, residual and percentage of one joint; the unit where there is one.
std::string FigureCells(double torque, double residual, double percent,
                        const char* unit) {
  return Format(" %9.3f %-3s %10.4f %-3s", torque, unit, residual, unit) +
         Percent(percent);
}

// Residuals of moving samples alone: at standstill friction can have any value,
// and a log that mostly rests would look well explained.
std::string ResidualTable(const Robot& robot, const LinearCalibration& result) {
  if (!result.training) return "";
  const auto fit = result.training->moving();
  std::string text = "\n" + Format("%-22s", "residual (rms)") +
                     "        torque       residual       %";
  if (result.validation) text += "      held out: torque  residual       %";
  text += "\n";
  for (int i = 0; i < robot.num_joints(); ++i) {
    const Joint& joint = robot.links[i].joint;
    const char* unit = EffortUnit(joint.type);
    text += Format("  %-20s", joint.name.c_str()) +
            FigureCells(fit.torque_rms[i], fit.residual_rms[i], fit.percent[i],
                        unit);
    if (result.validation) {
      const auto held_out = result.validation->moving();
      text +=
          "   " + FigureCells(held_out.torque_rms[i], held_out.residual_rms[i],
                              held_out.percent[i], unit);
    }
    text += "\n";
  }
  text += Format("  %-20s%29s", "all joints stacked", "") +
          Percent(fit.stacked_percent);
  if (result.validation) {
    text += Format("%32s", "") +
            Percent(result.validation->moving().stacked_percent);
  }
  return text + "\n";
}

// The first of them; a short log leaves dozens open, in long sums.
std::string DirectionsText(
    const std::string& what,
    const std::vector<UnidentifiableDirection>& directions) {
  constexpr size_t kShown = 3;
  const std::string indent(11, ' ');
  std::string text;
  for (size_t k = 0; k < std::min(kShown, directions.size()); ++k) {
    text += indent + what + directions[k].text + "\n";
  }
  if (directions.size() > kShown) {
    text += indent + Format("... and %zu more (in calibration.json)\n",
                            directions.size() - kShown);
  }
  return text;
}

// Directions of single blocks are named only where the whole sees everything:
// else they would be read as further faults beside those that matter.
std::string RankText(const Robot& robot, const LinearCalibration& result) {
  const Identifiability& id = result.identifiability;
  std::string blocks;
  for (size_t i = 0; i < id.block_rank.size(); ++i) {
    blocks += Format("%s%d/%d", i == 0 ? "" : " ", id.block_rank[i],
                     id.block_size[i]);
  }
  std::string text = Format("\nrank       %d of %d, blocks %s\n", id.batch_rank,
                            id.total, blocks.c_str());
  text += DirectionsText("not identifiable: ", id.directions);
  if (!id.advice.empty()) {
    text +=
        "           to see more: " + AdviceText(robot, id.advice, id.total) +
        ", or armcal excite " + OptionName("given") + "\n";
  }
  if (id.directions.empty()) {
    for (const auto& d : id.block_directions) {
      text += Format("           block %d alone does not see: ", d.block + 1) +
              d.text + "\n";
    }
  }
  for (const std::string& sentence : result.parameters.merged()) {
    text += "merged     " + sentence + "\n";
  }
  return text;
}

std::string UnpoweredText(const Robot& robot, const LogSet& training,
                          const LinearCalibration& result) {
  std::string text;
  for (const UnpoweredJoint& u : result.unpowered) {
    const auto logs = std::count_if(
        result.unpowered.begin(), result.unpowered.end(),
        [&](const UnpoweredJoint& other) { return other.joint == u.joint; });
    text += "unpowered  " + robot.links[u.joint].joint.name + " in " +
            training.path(u.log) +
            Format(
                ": %.3g %s rms is next to nothing beside gravity and "
                "inertia; %s\n",
                u.torque_rms, EffortUnit(robot.links[u.joint].joint.type),
                logs < training.size() ? "left out" : "used all the same");
  }
  return text;
}

std::string NoiseTable(const Robot& robot, const LinearCalibration& result) {
  if (result.sample_noise.empty()) return "";
  std::string text = "\nnoise of a torque sample, from\n";
  for (int i = 0; i < robot.num_joints(); ++i) {
    const SampleNoise& noise = result.sample_noise[i];
    const Joint& joint = robot.links[i].joint;
    text += Format("  %-20s %9.3g %-3s %s, %ld samples\n", joint.name.c_str(),
                   noise.stddev, EffortUnit(joint.type),
                   NoiseSourceName(noise.source), noise.samples);
  }
  return text;
}

std::string LengthTable(const LinearCalibration& result) {
  if (result.lengths.empty()) return "";
  std::string text = "\nlength              nominal m      estimate m\n";
  for (const RecoveredLength& l : result.lengths) {
    text += Format("  %-4s %-12s %9.5f  ", l.symbol.c_str(), l.name.c_str(),
                   l.nominal);
    text += l.identifiable ? Format("%11.6f +- %.2g\n", l.value, l.stddev)
                           : std::string("only products with moments seen\n");
  }
  return text;
}

// Of n samples of a motion that has all speeds up to its rms v alike, n w / v
// are slower than w. Where that is less than one sample, friction that changes
// sign over w is the same as one that changes it at once.
double SlowestSpeed(const LinearCalibration& result, int joint) {
  if (!result.training || joint >= result.mean_square_speed.size()) return 0;
  const auto samples = static_cast<double>(result.training->samples());
  return samples > 0 ? std::sqrt(result.mean_square_speed[joint]) / samples : 0;
}

std::string TransitionTable(const Robot& robot,
                            const LinearCalibration& result) {
  if (result.transitions.empty()) return "";
  std::string text = "\nCoulomb friction changes sign over\n";
  for (int i = 0; i < robot.num_joints(); ++i) {
    const CoulombTransition& t = result.transitions[i];
    const Joint& joint = robot.links[i].joint;
    const bool velocity = t.law == CoulombTransition::Law::kVelocity;
    const double told = velocity ? SlowestSpeed(result, i) : 0;
    text += Format("  %-20s %s%.3g %s%s\n", joint.name.c_str(),
                   t.width < told ? "less than " : "", std::max(t.width, told),
                   PositionUnit(joint.type),
                   velocity ? "/s (tanh)" : " (holds its torque at rest)");
  }
  return text;
}

std::string ParameterTable(const LinearCalibration& result) {
  std::string text = "\nmodel parameter                       value\n";
  for (int k = 0; k < result.parameters.size(); ++k) {
    const ModelParameter& p = result.parameters.parameters()[k];
    text += Format("  %-30s ", ReadableSum(p.name).c_str()) +
            PlusMinus(result.x[k], result.stddev[k]) + " " + p.unit + "\n";
  }
  return text + "standard deviations: " + result.covariance_method + "\n";
}

// Where samples that the fit left out make most of the squares that it leaves:
// ", most of it in spikes (4.3 % without)".
std::string SpikesText(const LinearCalibration& result) {
  const auto all = result.training->moving(), kept = result.training->kept();
  if (CountOutliers(result) == 0 ||
      !(all.residual_rms.squaredNorm() > 2 * kept.residual_rms.squaredNorm())) {
    return "";
  }
  return Format(", most of it in spikes (%.2f %% without)",
                kept.stacked_percent);
}

}  // namespace

// One line. Percentages are not finite where a log has no torque in motion.
std::string BriefReport(const Robot& robot, const LinearCalibration& result) {
  const Identifiability& id = result.identifiability;
  if (!result.solved) {
    return robot.name + ": not calibrated: " + result.reason;
  }
  const double left = result.training->moving().stacked_percent;
  std::string text =
      robot.name + Format(": %d model parameters, ", id.total) +
      (std::isfinite(left) ? Format("residual %.2f %% of the torque", left)
                           : "no torque where the logs move") +
      SpikesText(result);
  if (result.validation) {
    const double percent = result.validation->moving().stacked_percent;
    text += std::isfinite(percent) ? Format(", %.2f %% held out", percent)
                                   : ", no torque in the logs held out";
  }
  if (id.batch_rank < id.total) {
    const int unseen = id.total - id.batch_rank;
    text += Format("; %d direction%s not identifiable from this motion", unseen,
                   unseen == 1 ? "" : "s");
  }
  return text;
}

std::string EstimateText(const Robot& robot, const LinearCalibration& result) {
  std::string text = RankText(robot, result);
  if (result.solved) {
    text += LengthTable(result) + TransitionTable(robot, result) +
            ParameterTable(result);
  }
  text += "\n";
  for (const std::string& sentence : CalibrationWarnings(robot, result)) {
    text += "warning    " + sentence + "\n";
  }
  if (result.solved) text += VerdictText(Shortcomings(robot, result));
  return text;
}

std::string FullReport(const Robot& robot, const LogSet& training,
                       const LinearCalibration& result) {
  return DataText(training, result) + UnpoweredText(robot, training, result) +
         OutlierText(robot, result) + ResidualTable(robot, result) +
         NoiseTable(robot, result) + EstimateText(robot, result) +
         BriefReport(robot, result) + "\n";
}

std::string AdviceText(const Robot& robot,
                       const std::vector<AdvisedMotion>& motions, int total) {
  std::string text;
  for (const AdvisedMotion& motion : motions) {
    text += text.empty() ? "move " : ", then ";
    if (static_cast<int>(motion.joints.size()) == robot.num_joints() &&
        motion.joints.size() > 1) {
      text += "all joints";
    } else {
      for (size_t k = 0; k < motion.joints.size(); ++k) {
        text += (k ? " and " : "") + robot.links[motion.joints[k]].joint.name;
      }
    }
    if (motion.joints.size() > 1) text += " together";
    text += Format(" (%d of %d)", motion.rank, total);
  }
  return text;
}

}  // namespace armcal
