#include "calib/closed_loop/output_error_report.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/verdict.h"
#include "calib/numerics/json_figures.h"
#include "calib/refine/nonlinear_report.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using nlohmann::json;

// "  shoulder.viscous    0.25 -> 0.5086 +- 0.0048 N m s/rad".
std::string Line(const PhysicalParameter& p) {
  const std::string spread =
      p.at_bound ? "(bound)" : Format("+- %.2g", p.stddev);
  return Format("  %-26s %11.5g -> %11.5g %-11s %s\n", p.name.c_str(), p.prior,
                p.value, spread.c_str(), p.unit.c_str());
}

json LogsJson(const std::vector<CommandedLog>& logs) {
  json list = json::array();
  for (const CommandedLog& log : logs) {
    const double end = log.log.t[log.log.size() - 1];
    list.push_back({{"file", log.path},
                    {"samples", log.log.size()},
                    {"seconds", end},
                    {"begin_s", log.begin},
                    {"end_s", log.begin + end}});
  }
  return list;
}

json JointsJson(const Robot& robot, const OutputErrorCalibration& result) {
  json joints = json::array();
  const PositionFigures& positions = result.positions;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    const std::string unit = PositionUnit(joint.type);
    json entry = {
        {"name", joint.name},
        {"unit", EffortUnit(joint.type)},
        {"position_unit", unit},
        {"encoder_noise_stddev", JsonNumber(positions.noise[j])},
        {"nominal_position_residual_rms", JsonNumber(positions.nominal[j])}};
    if (result.arm.solved) {
      entry["position_residual_rms"] = JsonNumber(positions.calibrated[j]);
      entry["coulomb_transition"] = {
          {"law", "velocity"},
          {"width", result.values.arm.transitions[j].width},
          {"unit", unit + "/s"}};
    }
    if (positions.validation.size() > 0) {
      entry["validation_position_residual_rms"] =
          JsonNumber(positions.validation[j]);
      entry["nominal_validation_position_residual_rms"] =
          JsonNumber(positions.nominal_validation[j]);
    }
    joints.push_back(entry);
  }
  return joints;
}

// Why less is left than the encoders' noise makes. What is left holds that
// noise itself: where it is less than the noise, the noise was told too large,
// as by stamps that jitter, and nothing can be said of the loops.
std::string NoiseText(const OutputErrorCalibration& result) {
  constexpr double kShaken = .5, kOfNoise = .8;
  if (!(result.model_error < kShaken)) return "";
  const PositionFigures& positions = result.positions;
  const double left = std::sqrt(
      positions.calibrated.cwiseQuotient(positions.noise).squaredNorm() /
      static_cast<double>(positions.noise.size()));
  return left < kOfNoise
             ? "what is left is less than the encoder noise that the log seems "
               "to have: stamps that jitter, or rows far apart, look like such "
               "noise\n"
             : "the loops are near instability: linearised, they amplify "
               "encoder noise more than the arm was shaken; friction may be "
               "further off than its deviation says\n";
}

// That an estimate follows held-out commands worse than the robot file does, by
// more than all that the fit left, all joints together and each in units of its
// encoder's noise: it is no better model of the arm, whatever it made of the
// logs it was fitted to. (Of p parameters fitted to n equations with errors of
// variance s^2, the mean square on other data is larger by p s^2 / n, which is
// less than s^2, even where the file is the truth.) The joint that lost most is
// named.
void AddIfWorseThanFile(const Robot& robot, const PositionFigures& positions,
                        std::vector<std::string>* sentences) {
  if (positions.validation.size() == 0) return;
  if (!positions.validation.allFinite()) {
    sentences->push_back(
        "with the estimate the loop is unstable on the held-out commands");
    return;
  }
  // A joint that stood still has no noise, and would count for all others.
  const Eigen::VectorXd noise =
      positions.noise.cwiseMax(.1 * positions.noise.maxCoeff());
  const auto squares = [&](const Eigen::VectorXd& rms) -> Eigen::ArrayXd {
    return rms.cwiseQuotient(noise).array().square();
  };
  const Eigen::ArrayXd worse =
      squares(positions.validation) - squares(positions.nominal_validation);
  if (!(worse.sum() > squares(positions.calibrated).sum())) return;
  Eigen::Index j;
  worse.maxCoeff(&j);
  const Joint& joint = robot.links[j].joint;
  sentences->push_back(
      "the held-out commands are followed worse than by the robot file (" +
      joint.name +
      Format(": %.3g instead of %.3g %s rms", positions.validation[j],
             positions.nominal_validation[j], PositionUnit(joint.type)) +
      "): the controller's gains and limits, which count as exact where no "
      "trust is given, may not be the drive's, or the motion tells too little");
}

}  // namespace

std::vector<std::string> Shortcomings(const OutputErrorCalibration& result) {
  if (!result.arm.solved) return {result.arm.reason};
  std::vector<std::string> sentences;
  if (!result.arm.converged()) {
    sentences.push_back("the estimate did not come to rest in " +
                        std::to_string(result.arm.iterations) + " iterations");
  }
  AddIfWorseThanFile(result.arm.robot, result.positions, &sentences);
  const auto& parameters = result.arm.parameters;
  if (std::none_of(parameters.begin(), parameters.end(),
                   [](const auto& p) { return p.identifiable; })) {
    sentences.push_back("no parameter shows in this motion");
  }
  return sentences;
}

// Positions in and out of the fit beside the encoders' noise, which is what is
// left of a model that is right; then what was estimated, and what stays the
// file's.
std::string OutputErrorReport(const Robot& robot,
                              const OutputErrorCalibration& result) {
  std::string text;
  const PositionFigures& positions = result.positions;
  const bool solved = result.arm.solved;
  text +=
      "simulated minus measured positions, rms   robot file    estimate"
      "    held out    encoder noise\n";
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    const std::string held_out = positions.validation.size() > 0 && solved
                                     ? Format("%.3g", positions.validation[j])
                                     : "-";
    const std::string estimate =
        solved ? Format("%.3g", positions.calibrated[j]) : "-";
    text += Format("  %-38s %11.3g %11s %11s %11.3g %s\n", joint.name.c_str(),
                   positions.nominal[j], estimate.c_str(), held_out.c_str(),
                   positions.noise[j], PositionUnit(joint.type));
  }
  if (solved) {
    text +=
        NoiseText(result) +
        Format("residuals are %.2f times what encoder noise makes of them\n",
               result.model_error) +
        "\nestimated                       robot file       estimate\n";
    int open = 0;
    for (const PhysicalParameter& p : result.arm.parameters) {
      if (p.identifiable || p.at_bound) text += Line(p);
      open += !p.held && !p.identifiable;
    }
    if (open > 0) {
      text += Format("%d further parameters are not determined by the data: ",
                     open) +
              "the file's, as far as it is trusted\n";
    }
    constexpr size_t kShown = 6;
    const auto& unseen = result.arm.unseen;
    for (size_t k = 0; k < std::min(kShown, unseen.size()); ++k) {
      text += "not seen   " + unseen[k] + "\n";
    }
    if (unseen.size() > kShown) {
      text += Format("not seen   ... %zu more (in calibration.json)\n",
                     unseen.size() - kShown);
    }
  }
  return text + VerdictText(Shortcomings(result));
}

json OutputErrorJson(const Robot& robot,
                     const std::vector<CommandedLog>& training,
                     const std::vector<CommandedLog>& validation,
                     const OutputErrorCalibration& result) {
  json out = {{"format", "armcal calibration 1"},
              {"robot", robot.name},
              {"estimate", "refined"},
              {"method", "output_error"},
              {"bandwidth_hz", 0},
              {"joints", JointsJson(robot, result)},
              {"geometry", json::array()},
              {"logs", LogsJson(training)},
              {"model_error", JsonNumber(result.model_error)},
              {"verdict", VerdictJson(Shortcomings(result))},
              {"refined",
               {{"converged", result.arm.converged()},
                {"reason", result.arm.reason},
                {"iterations", result.arm.iterations}}},
              {"termination",
               {{"converged", result.arm.converged()},
                {"reason", result.arm.reason},
                {"iterations", result.arm.iterations}}}};
  if (!validation.empty()) out["validation_logs"] = LogsJson(validation);
  if (result.arm.solved) AddParameters(result.arm, &out);
  return out;
}

}  // namespace armcal
