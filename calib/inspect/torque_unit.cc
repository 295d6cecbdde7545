#include "calib/inspect/torque_unit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "calib/inspect/held_out_fit.h"
#include "calib/numerics/median.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// Share of the torque that is left beside the file's inertias, read in the
// unit. A scale s leaves |1 - u / s| in the unit u: this takes it for s of 0.6
// u to 3.3 u.
constexpr double kMostLeftInUnit = .7;
// What an arm like the file's leaves of a torque that is read rightly, share of
// squares (10 % of the rms): what is below is not told apart.
constexpr double kUsualShare = .01;
// Nats by which what is left of torques held out has to fall, over all joints
// together: half of one joint's beyond the usual.
const double kLeastScaleGain = std::log(2.);

struct TorqueUnit {
  double size;  // of one N m in it
  const char* sentence;
  const char* header;  // behind the name of its columns
};
constexpr TorqueUnit kTorqueUnits[] = {
    {1e3, "in mN m or N mm, not in N m", "[mNm]"},
    {1e-3, "in kN m, not in N m", "[kNm]"}};

// Of single joints the fit is asked besides.
bool IsAbove(const TorqueScales& scales, int j) {
  return scales.low[j] > kNotInertia;
}
bool IsBelow(const TorqueScales& scales, int j) {
  return scales.low[j] > 0 && scales.high[j] < 1 / kNotInertia;
}

// Median of what the file's links and friction leave of the joints' torques.
double LeftIn(const TorqueScales& scales, const std::vector<int>& joints,
              double unit) {
  std::vector<double> left;
  for (const int j : joints) left.push_back(scales.Left(j, unit));
  return Median(left);
}

// The unit that the joints' torques are in, by the file; null where none of
// those that have a name fits. The median: one link's mass may be wrong.
const TorqueUnit* UnitOf(const TorqueScales& scales,
                         const std::vector<int>& joints) {
  for (const TorqueUnit& unit : kTorqueUnits) {
    const double left = LeftIn(scales, joints, unit.size);
    if (left < kMostLeftInUnit && left < LeftIn(scales, joints, 1)) {
      return &unit;
    }
  }
  return nullptr;
}

// Currents, and torques before the gear, are as much smaller as constants and
// ratios have it; the scale alone does not tell which of them it is.
std::string RemedyOf(const TorqueUnit* unit, bool above, int j) {
  const std::string kind = OptionName("torque_kind"),
                    ratios = OptionName("gear_ratios");
  if (unit != nullptr) {
    return j < 0 ? std::string("name the columns tau1") + unit->header + " ..."
                 : "name the column tau" + std::to_string(j + 1) + unit->header;
  }
  if (above) {
    return "log N m, or give the factors to N m as " + kind + "=motor " +
           ratios + "=..";
  }
  return kind + "=current " + OptionName("torque_constants") + "=.., or " +
         kind + "=motor " + ratios + "=..; the log does not tell which";
}

// Without evidence; joint -1: all.
InspectionFinding UnitFinding(const Robot& robot, const TorqueUnit* unit,
                              bool above, int j) {
  InspectionFinding finding;
  finding.joint = j;
  finding.finding =
      above || unit != nullptr ? "torque_unit" : "torque_is_current";
  const std::string what =
      unit != nullptr ? unit->sentence
      : above         ? "in another unit than N m"
      : j < 0         ? "motor currents, or of the motors' side of gears"
                      : "a motor current, or of the motor's side of a gear";
  finding.sentence =
      j < 0 ? "the torques are " + what
            : "the torque of " + robot.links[j].joint.name + " is " + what;
  finding.remedy = RemedyOf(unit, above, j);
  return finding;
}

// All joints that are told, and in one direction.
InspectionFinding OfAll(const Robot& robot, const TorqueScales& scales,
                        const std::vector<int>& told, bool above) {
  const TorqueUnit* unit = UnitOf(scales, told);
  InspectionFinding finding = UnitFinding(robot, unit, above, -1);
  double low = scales.low[told[0]], high = scales.high[told[0]];
  for (const int j : told) {
    low = std::min(low, scales.low[j]);
    high = std::max(high, scales.high[j]);
  }
  finding.evidence = Format(
      "%.4g to %.4g times what the robot file's links need (95 %%)", low, high);
  if (unit == nullptr) return finding;
  finding.evidence += Format(
      "; read so, the file's links and friction leave %.0f %% of the torques, "
      "the joints' median",
      100 * LeftIn(scales, told, unit->size));
  return finding;
}

// Whether an arm, its inertias free, explains unseen torques clearly better
// once those of joint j are divided. Each joint counts by its own share of
// squares: sizes in two units do not add.
bool IsBetterScaled(const HeldOutFit& as_is, const HeldOutFit& changed, int j) {
  for (int row = 0; row < 3; ++row) {
    const double gain = ((as_is.joints.row(row).array() + kUsualShare) /
                         (changed.joints.row(row).array() + kUsualShare))
                            .log()
                            .sum();
    if (!(gain > kLeastScaleGain) || !(changed.joints(row, j) < .5)) {
      return false;
    }
  }
  return true;
}

InspectionFinding OfOne(const Robot& robot, const TorqueScales& scales, int j,
                        const HeldOutFit& as_is, const HeldOutFit& changed) {
  const auto percent = [](const HeldOutFit& fit) {
    return 100 * std::sqrt(fit.joints.topRows(2).mean());
  };
  InspectionFinding finding =
      UnitFinding(robot, UnitOf(scales, {j}), scales.scale[j] > 1, j);
  finding.held_out_before = percent(as_is);
  finding.held_out_after = percent(changed);
  finding.evidence = Format(
      "%.4g times what the robot file's links need (95 %%: %.4g to %.4g); of "
      "torques held out a fit leaves %.3g %% as logged and %.3g %% divided by "
      "that, rms over the joints",
      scales.scale[j], scales.low[j], scales.high[j], finding.held_out_before,
      finding.held_out_after);
  return finding;
}

// Those of `joints` that are confirmed one after the other, the scale that is
// farthest from 1 first, beside those that are.
std::vector<InspectionFinding> OfSome(const Robot& robot, WiringSamples samples,
                                      const TorqueScales& scales,
                                      std::vector<int> joints) {
  const auto far = [&](int j) { return std::abs(std::log(scales.scale[j])); };
  std::sort(joints.begin(), joints.end(),
            [&](int a, int b) { return far(a) > far(b); });
  std::vector<InspectionFinding> findings;
  HeldOutFit as_is = FitHeldOut(robot, samples);
  for (const int j : joints) {
    WiringSamples scaled = samples;
    scaled.tau.col(j) /= scales.scale[j];
    const HeldOutFit changed = FitHeldOut(robot, scaled);
    if (!IsBetterScaled(as_is, changed, j)) continue;
    findings.push_back(OfOne(robot, scales, j, as_is, changed));
    samples = scaled;
    as_is = changed;
  }
  return findings;
}

// Whether a scale beyond the factor is that of all joints: of most that are
// told, three at least, the others on the same side of 1. A joint that friction
// moves may have any.
bool IsOfAll(const std::vector<int>& beyond, const std::vector<int>& told,
             const TorqueScales& scales, bool above) {
  if (beyond.size() == told.size()) return true;
  const bool is_of_most = beyond.size() >= 3 && 2 * beyond.size() > told.size();
  return is_of_most && std::all_of(told.begin(), told.end(), [&](int j) {
           return above ? scales.low[j] > 1 : scales.high[j] < 1;
         });
}

}  // namespace

std::vector<InspectionFinding> FindTorqueUnits(const Robot& robot,
                                               const WiringSamples& samples,
                                               const TorqueScales& scales) {
  std::vector<int> told, above, below;
  for (int j = 0; j < robot.num_joints(); ++j) {
    if (!scales.told(j)) continue;
    told.push_back(j);
    if (IsAbove(scales, j)) above.push_back(j);
    if (IsBelow(scales, j)) below.push_back(j);
  }
  if (told.empty()) return {};
  // One of several joints could be heavier than the file has it.
  if (told.size() > 1 || robot.num_joints() == 1) {
    for (const bool up : {true, false}) {
      if (IsOfAll(up ? above : below, told, scales, up)) {
        return {OfAll(robot, scales, told, up)};
      }
    }
  }
  above.insert(above.end(), below.begin(), below.end());
  if (above.empty()) return {};
  return OfSome(robot, samples, scales, above);
}

}  // namespace armcal
