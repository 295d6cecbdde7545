#include "tools/commands/excite.h"

#include "calib/excite/effect_separation.h"
#include "calib/excite/excitation_report.h"
#include "calib/excite/given_information.h"
#include "calib/excite/posture_report.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "calib/linear/error_density.h"
#include "calib/refine/given_calibration.h"
#include "model/log_files/log_writer.h"
#include "model/text/input_error.h"
#include "tools/command_report.h"
#include "tools/commands/calibrate_refined.h"
#include "tools/commands/excite_flags.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/report/report_data.h"

namespace armcal {
namespace {

// Friction changes sign within this, rad/s or m/s: wide enough for a search
// that follows slopes.
constexpr double kTransition = .05;

const std::vector<JointTerm> kTerms = {JointTerm::kViscous, JointTerm::kCoulomb,
                                       JointTerm::kOffset,
                                       JointTerm::kArmature};

// What a motion is designed with.
struct Design {
  ModelParameters model;
  Eigen::VectorXd noise;  // of a sample
  Eigen::MatrixXd known;  // of the model parameters
  ReferenceScale reference;
};

ModelParameters ModelFor(const Robot& robot, DesignTarget target) {
  ModelParameters::Options options;
  if (target == DesignTarget::kGeometry) {
    options.geometry = GeometryKnowledge::kNonzeroLengths;
  }
  options.joint_terms = kTerms;
  options.transitions.assign(
      robot.num_joints(), {{CoulombTransition::Law::kVelocity, kTransition}});
  return {robot, options};
}

GivenCalibration LearnFromLogs(const CommandInput& input, const Robot& robot,
                               const std::vector<std::string>& paths,
                               const ModelParameters& model) {
  const LogSet logs(SourcesOf(input, paths),
                    LogOptionsFromFlags(input.flags, robot),
                    CropFromFlags(input.flags));
  LinearCalibrationOptions options;
  options.joint_terms = kTerms;
  options.bandwidth_hz = BandwidthFromFlags(input.flags);
  options.progress = input.progress;
  const LinearCalibration linear =
      CalibrateLinear(robot, options, logs, nullptr);
  if (!linear.solved) {
    throw InputError(paths[0], "", "", "--given: " + linear.reason);
  }
  const Eigen::VectorXd density = ErrorDensity(linear);
  return {density, GivenInformation(robot, model, density, input.progress,
                                    Prepare(logs, linear.preparation))};
}

// How large errors of the torque are, and what is known already.
void LearnFromGiven(const CommandInput& input, const Robot& robot,
                    double rate_hz, Design* design) {
  const Given given = GivenFromFlags(input.flags);
  if (given.empty()) return;
  const GivenCalibration known =
      given.calibration.empty()
          ? LearnFromLogs(input, robot, given.logs, design->model)
          : ReadGivenCalibration(given.calibration, robot, design->model);
  design->known = known.A;
  design->noise = (known.density * rate_hz).cwiseSqrt();
}

Design MakeDesign(const CommandInput& input, const Robot& robot,
                  const ExcitationOptions& options,
                  std::vector<std::string>* assumed) {
  Design design{ModelFor(robot, TargetFromFlags(input.flags)), {}, {}, {}};
  const int m = design.model.size();
  design.known = Eigen::MatrixXd::Zero(m, m);
  const Eigen::VectorXd& speed = options.limits.velocity;
  design.reference = MakeReferenceScale(
      design.model, speed.mean() / 2, .5, 1,
      Eigen::VectorXd::Zero(robot.num_joints()), design.model.Values(robot));
  const Eigen::VectorXd shares =
      NoiseSharesFromFlags(input.flags, robot.num_joints());
  design.noise = shares.cwiseProduct(design.reference.torque);
  LearnFromGiven(input, robot, options.rate_hz, &design);
  for (const Link& link : robot.links) {
    if (!link.has_inertial) {
      assumed->push_back("nothing weighs link " + link.name);
    }
  }
  return design;
}

// Positions and velocities of one period.
nlohmann::json MotionJson(const Robot& robot, const Log& motion) {
  if (motion.size() == 0) return nullptr;
  nlohmann::json joints = nlohmann::json::array();
  for (const Link& link : robot.links) {
    joints.push_back(
        {{"name", link.joint.name}, {"unit", PositionUnit(link.joint.type)}});
  }
  return {{"t", RoundedJson(motion.t)},
          {"q", SignalsJson(motion.q)},
          {"qd", SignalsJson(motion.qd)},
          {"joints", joints}};
}

std::vector<std::string> FilesOfDesign(const FlagValues& flags) {
  const Given given = GivenFromFlags(flags);
  std::vector<std::string> files = given.logs;
  if (!given.calibration.empty()) files.push_back(given.calibration);
  return files;
}

CommandOutcome RunPostures(const CommandInput& input, const Robot& robot,
                           const PostureOptions& options,
                           const std::vector<std::string>& assumed) {
  const PostureDesign design =
      MakeForRobot(input, "", [&] { return DesignPostures(robot, options); });
  const PostureSummary summary{robot, options, design, assumed};
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  out.Add("postures.csv", PostureText(design));
  const nlohmann::json json = ToJson(summary);
  const std::string text = json.dump(2) + "\n";
  out.Add("excite.json", text);
  const auto draw = [&](ReportContent* content) {
    content->extra["postures"] = PosturesJson(robot, design.q);
  };
  AddReport(input, "excite", robot, text, FilesOfDesign(input.flags), draw,
            &out);
  outcome.output = {text, FullReport(summary), "", true, {}};
  return outcome;
}

CommandOutcome Finish(const CommandInput& input,
                      const ExcitationSummary& summary) {
  CommandOutcome outcome;
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  const nlohmann::json json = ToJson(summary);
  Log motion;
  const bool found = summary.excitation.numbers.size() > 0;
  if (found) {
    motion = MotionLog(summary.excitation, summary.options.periods,
                       summary.options.rate_hz);
    out.Add("trajectory.csv", LogText(motion));
  }
  const std::string text = json.dump(2) + "\n";
  out.Add("excite.json", text);
  const auto draw = [&](ReportContent* content) {
    content->extra["motion"] = MotionJson(summary.robot, motion);
  };
  AddReport(input, "excite", summary.robot, text, FilesOfDesign(input.flags),
            draw, &out);
  outcome.output = {text, FullReport(summary), "", found, {}};
  return outcome;
}

CommandOutcome RunParameters(const CommandInput& input, const Robot& robot,
                             const Design& design,
                             const ExcitationOptions& options,
                             const std::vector<std::string>& assumed) {
  const NamedQuantities quantities = MakeDesignQuantities(
      robot, design.model, kTerms, TargetFromFlags(input.flags),
      TrustFromFlags(input.flags), design.reference, design.known);
  const Excitation excitation =
      DesignExcitation(robot, design.model, quantities.design, options);
  ExcitationSummary summary{robot, options, quantities, excitation,
                            {},    assumed, {}};
  if (!GivenFromFlags(input.flags).empty()) {
    summary.given_stddev = PredictedStddev(
        quantities.design,
        Eigen::MatrixXd::Zero(design.model.size(), design.model.size()));
  }
  return Finish(input, summary);
}

CommandOutcome RunSeparation(const CommandInput& input, const Robot& robot,
                             const Design& design,
                             const std::vector<const Effect*>& effects,
                             const ExcitationOptions& options,
                             const std::vector<std::string>& assumed) {
  const auto question = MakeForRobot(input, "--separate: ", [&] {
    return SeparationQuestion(robot, effects, design.model, options.limits);
  });
  const EffectSeparation separation =
      SeparateEffects(robot, design.model, question, design.known, options);
  const NamedQuantities quantities = Quantities(robot, separation);
  ExcitationSummary summary{robot, options, quantities, separation.motion,
                            {},    assumed, {}};
  summary.alone_stddev.resize(static_cast<long>(separation.sizes.size()));
  for (size_t k = 0; k < separation.sizes.size(); ++k) {
    summary.alone_stddev[static_cast<long>(k)] = separation.sizes[k].alone;
  }
  return Finish(input, summary);
}

CommandOutcome RunMotion(const CommandInput& input, const Robot& robot) {
  std::vector<std::string> assumed;
  ExcitationOptions options =
      ExcitationOptionsFromFlags(input, robot, &assumed);
  const std::vector<const Effect*> effects =
      SeparatedEffectsFromFlags(input.flags);
  input.Begin("preparing the design");
  options.progress = input.progress;
  const Design design = MakeDesign(input, robot, options, &assumed);
  options.torque_noise = design.noise;
  return effects.empty()
             ? RunParameters(input, robot, design, options, assumed)
             : RunSeparation(input, robot, design, effects, options, assumed);
}

CommandOutcome RunExcite(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  std::vector<std::string> assumed;
  const std::optional<PostureOptions> postures =
      PostureOptionsFromFlags(input, robot, &assumed);
  if (!postures) return RunMotion(input, robot);
  input.Begin("designing postures");
  return RunPostures(input, robot, *postures, assumed);
}

}  // namespace

Command ExciteCommand() {
  std::vector<FlagGroup> groups = ExcitationFlagGroups();
  groups.push_back({"logs that exist", {"bandwidth", "crop"}, false});
  groups.push_back(TorqueFlags());
  groups.push_back(ChainFlags());
  return {
      "excite",
      "the motion that tells most about a robot within its limits, and how "
      "well it will tell",
      groups,
      {"armcal excite --robot=arm.urdf --duration=20 --floor=0 --out=motion",
       "armcal excite --robot=arm.urdf --separate=elasticity,delay "
       "--given=log.csv"},
      &RunExcite};
}

}  // namespace armcal
