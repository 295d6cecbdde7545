#include "calib/poses/diagnosis/report.h"

#include <algorithm>
#include <cmath>

#include "calib/poses/diagnosis/interval.h"
#include "calib/poses/pose_label.h"
#include "model/text/format.h"

namespace armcal {
namespace {

// Amounts of an effect that a screen has room for.
constexpr size_t kAmountsShown = 3;
// Poses that are named of those that fit badly.
constexpr size_t kRowsShown = 12;

std::string InMillimetres(double x) { return Format("%.3g mm", 1e3 * x); }

std::string AmountText(const PoseAmount& amount) {
  double scale = 1;
  std::string unit = amount.unit;
  if (unit == "1" || unit == "rad/rad") {
    unit.clear();
  } else {
    scale = 1e3;
    unit = unit == "m" ? " mm" : " m" + unit;
  }
  return amount.name + Format(" %.5g", scale * amount.value) +
         (std::isfinite(amount.half_width)
              ? Format(" +- %.2g", scale * amount.half_width)
              : std::string(" +- ?")) +
         unit;
}

// Where logs have told an amount, too: what each says by itself.
std::string ToldText(const PoseFinding& finding) {
  constexpr double kClearlyApart = 3;  // standard deviations
  std::string text;
  for (const PoseAmount& amount : finding.amounts) {
    if (!(amount.told.stddev > 0)) continue;
    text += "         " + amount.name +
            Format(": logs alone %.3g +- %.2g, poses alone %.3g +- %.2g ",
                   amount.told.value, kNormal95 * amount.told.stddev,
                   amount.by_poses.value, kNormal95 * amount.by_poses.stddev) +
            amount.unit;
    if (amount.Apart() > kClearlyApart) {
      text += Format(
          ": %.1f standard deviations apart, which is no one "
          "spring (links and bearings bend in poses, too)",
          amount.Apart());
    }
    text += "\n";
  }
  return text;
}

std::string AmountsText(const PoseFinding& finding) {
  std::string text;
  // Those that are 0, at their least, last.
  std::vector<PoseAmount> amounts = finding.amounts;
  std::stable_partition(
      amounts.begin(), amounts.end(),
      [](const PoseAmount& amount) { return amount.value != 0; });
  const size_t shown = std::min(amounts.size(), kAmountsShown);
  for (size_t k = 0; k < shown; ++k) {
    text += (k > 0 ? ", " : "") + AmountText(amounts[k]);
  }
  if (finding.placed.effect->is_harmonic) {
    text +=
        ": " + AmountText(LengthOf("amplitude", finding.amounts, finding.ci95));
  }
  if (shown < finding.amounts.size()) {
    text += Format(", and %zu more", finding.amounts.size() - shown);
  }
  return text;
}

std::string SharePercent(double share) {
  return Format("%.4g %%", std::max(-999.0, 100 * share));
}

std::string SideText(const char* name, const int range[2],
                     const PoseCampaign& campaign, int shift) {
  if (range[0] < 0 || range[0] == range[1]) return "";
  return Format("; %s between %ss %ld and %ld", name, campaign.word.c_str(),
                campaign.number[range[0] - shift],
                campaign.number[range[1] - shift]);
}

std::string EquivalentText(const PoseFinding& finding) {
  constexpr double kShown = .005;  // what is not 0 % where it is rounded
  std::string text;
  if (finding.none > kShown) {
    text += Format("         or %2.0f %%  no effect\n", 100 * finding.none);
  }
  if (finding.equivalents.empty()) return text;
  for (const PoseEquivalent& other : finding.equivalents) {
    text += Format("         or %2.0f %%  ", 100 * other.probability) +
            other.name + "\n";
  }
  const PoseEquivalent& first = finding.equivalents[0];
  if (first.told_apart_at.size() == 0) {
    return text + "         told apart by " +
           finding.placed.effect->separate_by + "\n";
  }
  text += "         told apart at q =";
  for (const double q : first.told_apart_at) text += Format(" %.2f", q);
  return text + " (the first two differ by " + InMillimetres(first.differ) +
         " there)\n";
}

// Of a gear ratio of -1: its joint's positions have to be negated.
std::string DirectionText(const PoseFinding& finding,
                          const PoseCampaign& campaign) {
  if (!CountsTheOtherWay(finding)) return "";
  return "         " +
         campaign.robot().links[finding.placed.place.joint].joint.name +
         " counts the other way than in the robot file: expected its "
         "positions negated\n";
}

std::string FindingText(const PoseFinding& finding,
                        const PoseCampaign& campaign) {
  return Format("  %3.0f %%  ", 100 * finding.probability) + finding.name +
         ": " + AmountsText(finding) + "\n         " +
         finding.placed.effect->means + "; moves " +
         InMillimetres(finding.displacement_rms) + " rms, " +
         InMillimetres(finding.displacement_max) + " at most; removes " +
         SharePercent(finding.interleaved.removed_share) +
         SideText("begins", finding.begin, campaign, 0) +
         SideText("ends", finding.end, campaign, 1) + "\n" +
         DirectionText(finding, campaign) + ToldText(finding) +
         EquivalentText(finding);
}

std::string GapLine(const char* name, double file, double geometry,
                    double after) {
  return Format("%-34s", name) +
         (file > 0 ? Format("%12.4g", 1e3 * file) : std::string(12, ' ')) +
         Format("%12.4g%12.4g\n", 1e3 * geometry, 1e3 * after);
}

std::string GapText(const PoseGap& gap) {
  return "\ndistances, mm rms                         frame    geometry     "
         "effects\n" +
         GapLine("  fitted", gap.file, gap.geometry, gap.after) +
         GapLine("  held out, every sixth pose", 0, gap.held_out_geometry,
                 gap.held_out_after) +
         GapLine("  held out, a sixth of the order", 0, gap.stretches_geometry,
                 gap.stretches_after);
}

// Where every sixth pose is predicted and a sixth of the order at a time is
// not, what explains the poses shows in one stretch of them alone. Twice the
// distance is four times the square, which six parts of noise do not differ by.
std::string UnpredictedText(const PoseGap& gap) {
  if (!(gap.stretches_after > 2 * gap.held_out_after)) return "";
  return "  a stretch of poses is not predicted by the others (" +
         InMillimetres(gap.stretches_after) +
         "): what explains it may be seen there alone\n";
}

// Of the joints by which what depends on the posture was taken anew.
std::string ZerosText(const Robot& robot, const PoseCampaign& campaign) {
  std::string names;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (std::abs(campaign.zeros[i]) < kStandsElsewhere) continue;
    names += (names.empty() ? "" : ", ") + robot.links[i].joint.name +
             Format(" by %.3g deg", campaign.zeros[i] * 180 / M_PI);
  }
  if (names.empty()) return "";
  return "  zeros are off the robot file's: " + names +
         "; loads are those of the arm as it stands\n";
}

std::string LeftText(const Robot& robot, const PoseMeasurements& measured,
                     const PoseDiagnosis& diagnosis) {
  const PoseMisfit& misfit = diagnosis.misfit;
  std::string text = "\nwhat is left\n  " +
                     InMillimetres(diagnosis.coordinate_rms) +
                     " rms of a coordinate";
  if (misfit.instrument_u95 > 0) {
    text += Format(", %.3g times the standard deviation of the instrument",
                   misfit.instrument_ratio) +
            " (u95 " + InMillimetres(misfit.instrument_u95) + ")";
  } else {
    text += "; the file states no uncertainty of the instrument (u95_1)";
  }
  text += Format("\n  successive poses correlate by %.2f +- %.2f\n",
                 misfit.order_correlation, misfit.order_stddev);
  text += UnpredictedText(diagnosis.gap);
  text += ZerosText(robot, diagnosis.model.campaign);
  if (!diagnosis.unconfirmed.empty()) {
    text += "  held-out poses do not confirm " + diagnosis.unconfirmed + "\n";
  }
  for (const UnlikelyPoseEffect& effect : diagnosis.unlikely) {
    text += Format("  %.0f %%  ", 100 * effect.probability) + effect.name +
            Format(": not claimed, no effect is as likely (%.0f %%)\n",
                   100 * effect.none);
  }
  if (diagnosis.outliers.empty()) return text;
  text += Format("  %zu fit badly, %ss", diagnosis.outliers.size(),
                 PoseWord(measured));
  for (size_t k = 0; k < std::min(diagnosis.outliers.size(), kRowsShown); ++k) {
    text += Format(" %ld", PoseLabel(measured, diagnosis.outliers[k]));
  }
  return text + (diagnosis.outliers.size() > kRowsShown ? " ...\n" : "\n");
}

std::string NextText(const PoseDiagnosis& diagnosis) {
  bool order = false, posture = false;
  std::string text;
  for (const PoseFinding& finding : diagnosis.findings) {
    const PoseEffect& effect = *finding.placed.effect;
    if (IsNamed(finding)) {
      (effect.in_order ? order : posture) = true;
    } else {
      text +=
          "  to tell what the cause is, measure " + effect.separate_by + "\n";
    }
  }
  if (order) {
    text +=
        "  fix what moved and measure again, or calibrate each stretch of "
        "poses by itself\n";
  }
  if (posture) {
    text +=
        "  correct the joint positions by the amounts above before poses "
        "are calibrated or commanded\n";
  }
  const bool more = diagnosis.verdict == PoseVerdict::kPartlyExplained ||
                    diagnosis.verdict == PoseVerdict::kUnknown;
  if (more) {
    text +=
        "  what is left is no effect of the list: measure the first poses "
        "again at the end, and\n  others in another order and with "
        "another payload\n";
  }
  return text.empty() ? text : "\nnext\n" + text;
}

}  // namespace

std::string PoseDiagnosisReport(const Robot& robot,
                                const PoseMeasurements& measured,
                                const PoseDiagnosis& diagnosis) {
  if (diagnosis.verdict == PoseVerdict::kNotTestable) {
    return PoseSentence(diagnosis) + "\n";
  }
  const PoseCampaign campaign = MakeCampaign({robot}, measured, measured.q);
  std::string text = PoseSentence(diagnosis) + "\n";
  if (!diagnosis.findings.empty())
    text += "\nwhich effect (how probable; values +- 95 %)\n";
  for (const PoseFinding& finding : diagnosis.findings) {
    text += FindingText(finding, campaign);
  }
  return text + GapText(diagnosis.gap) + LeftText(robot, measured, diagnosis) +
         NextText(diagnosis);
}

}  // namespace armcal
