#include "calib/refine/nonlinear_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/text/format.h"
namespace armcal {
namespace {

// Text in a column of this width; longer text makes the row longer.
std::string PaddedCell(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

constexpr size_t kValueWidth = 22;

// "12.3 +- 0.4", or "12.3 (not alone)" where the logs tell it only together
// with others, or not at all: then the prior decides among what fits alike.
std::string Value(const PhysicalParameter& p) {
  const std::string value = Format("%9.4g ", p.value);
  return PaddedCell(value + (p.held           ? "(held)"
                             : p.identifiable ? Format("+- %.2g", p.stddev)
                             : p.at_bound     ? "(bound)"
                                              : "(not alone)"),
                    kValueWidth);
}

const PhysicalParameter* Find(const NonlinearCalibration& result,
                              const std::string& name) {
  for (const PhysicalParameter& p : result.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

std::string Percent(const TorqueResidual& residual) {
  const double percent = residual.moving().stacked_percent;
  return std::isfinite(percent) ? Format("%.2f %%", percent)
                                : "unknown (no torque)";
}

// Masses beside the file's; the centre of mass is the first moment over the
// mass.
std::string LinkTable(const Robot& nominal, const Robot& robot) {
  const std::string title = "robot for a simulator";
  size_t width = title.size() + 1;
  for (const Link& link : robot.links) {
    width = std::max(width, link.name.size() + 3);
  }
  std::string text = "\n" + PaddedCell(title, width) +
                     "  mass kg    (file)   centre of mass x, y, z m\n";
  for (size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    if (IsDeclaredMassless(link)) {
      text += PaddedCell("  " + link.name, width) +
              "    no mass: it joins two joints of one body\n";
      continue;
    }
    const Eigen::Vector3d com = link.inertial.first_moment / link.inertial.mass;
    text += PaddedCell("  " + link.name, width) +
            Format("%9.3f ", link.inertial.mass) +
            Format("%9s",
                   Format("(%.3f)", nominal.links[i].inertial.mass).c_str()) +
            Format("   %9.4f %9.4f %9.4f\n", com.x(), com.y(), com.z());
  }
  return text;
}

// Trailing blanks are cut from each row, since cells are padded.
std::string JointTable(const NonlinearCalibration& result) {
  size_t width = 8;
  for (const Link& link : result.robot.links) {
    width = std::max(width, link.joint.name.size() + 3);
  }
  const std::vector<std::string> terms = {"viscous", "coulomb", "armature"};
  std::string text = "\n" + PaddedCell("  joint", width);
  for (const auto& term : terms) text += PaddedCell("  " + term, kValueWidth);
  for (const Link& link : result.robot.links) {
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n" + PaddedCell("  " + link.joint.name, width);
    for (const auto& term : terms) {
      text += Value(*Find(result, link.joint.name + "." + term));
    }
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

// Lengths in mm and angles in degrees, as people read them.
std::string GeometryTable(const NonlinearCalibration& result) {
  std::string text;
  for (const PhysicalParameter& p : result.parameters) {
    if (!p.geometry) continue;
    const bool angle = p.unit == "rad", length = p.unit == "m";
    const double scale = angle ? 180 / M_PI : length ? 1e3 : 1;
    text += PaddedCell("  " + p.name, 24) +
            Format("%12.4f -> ", scale * p.prior) +
            Format("%12.4f ", scale * p.value) +
            (p.identifiable ? Format("+- %-9.2g", scale * p.stddev)
                            : PaddedCell("(prior)", 12)) +
            (angle    ? " deg\n"
             : length ? " mm\n"
                      : "\n");
  }
  if (text.empty()) return text;
  return "\ngeometry                        file       estimate\n" + text;
}

// Says which lengths of the linear calibration this robot has: those that were
// seen by themselves, those of which only sums were, and those of the file.
std::string LengthText(const NonlinearCalibration& result) {
  std::string seen, moved, kept;
  for (const RecoveredLength& l : result.lengths) {
    std::string& list = l.identifiable         ? seen
                        : l.value != l.nominal ? moved
                                               : kept;
    list += (list.empty() ? "" : ", ") + l.name;
    if (&list == &moved) list += Format(" (%.6f m)", l.value);
  }
  std::string text;
  if (!seen.empty()) {
    text += "\nlengths    " + seen + " as estimated above; the links are " +
            "estimated with these taken for exact";
  }
  if (!moved.empty()) {
    text += "\nlengths    " + moved + ": only their sums are seen; as near " +
            "the file's as these allow";
  }
  if (!kept.empty()) {
    text += "\nlengths    " + kept + " as in the file: not seen alone";
  }
  return text;
}

std::string PoseText(const NonlinearCalibration& result) {
  if (!result.poses) return "";
  const PoseFigures& poses = *result.poses;
  return Format("\nposes      %.4f mm rms with the file's geometry, ",
                1e3 * poses.before_rms) +
         Format("%.4f mm with the estimate (max %.4f mm)", 1e3 * poses.rms,
                1e3 * poses.max);
}

// How many parameters the data determine, and the three strongest correlations.
std::string CertaintyText(const NonlinearCalibration& result) {
  int estimated = 0, identifiable = 0;
  for (const PhysicalParameter& p : result.parameters) {
    estimated += !p.held;
    identifiable += p.identifiable;
  }
  std::string text = "\n" + std::to_string(identifiable) + " of " +
                     std::to_string(estimated) +
                     " parameters determined by the data, the others only in "
                     "sums with these, or by the file as far as it is trusted";
  const auto strong = StrongCorrelations(result);
  constexpr size_t kShown = 3;
  for (size_t k = 0; k < std::min(kShown, strong.size()); ++k) {
    text += (k == 0 ? "\ncorrelated " : ", ") +
            result.parameters[strong[k].a].name + " and " +
            result.parameters[strong[k].b].name +
            Format(" (%.3f)", strong[k].value);
  }
  if (strong.size() > kShown) {
    text += Format(", and %zu more pairs", strong.size() - kShown);
  }
  return text;
}

}  // namespace

std::string NonlinearReport(const Robot& nominal,
                            const NonlinearCalibration& result) {
  if (!result.solved) {
    return "\nno physically consistent robot: " + result.reason + "\n";
  }
  std::string text = LinkTable(nominal, result.robot) + JointTable(result) +
                     GeometryTable(result) + "\nresidual of this robot " +
                     Percent(*result.training);
  if (result.validation) text += ", held out " + Percent(*result.validation);
  text += LengthText(result) + PoseText(result) + CertaintyText(result);
  if (!result.converged()) {
    text += "\nnot converged: " + result.reason + " after " +
            std::to_string(result.iterations) + " iterations";
  }
  return text + "\n";
}

}  // namespace armcal
