#include "calib/excite.h"

#include "calib/excite/effect_separation.h"
#include "calib/excite/excitation_report.h"
#include "calib/excite/given_information.h"
#include "calib/excite/posture_report.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/error_density.h"
#include "calib/motion_options.h"
#include "calib/refine/given_calibration.h"
#include "model/effects/effects.h"
#include "model/log_files/log_writer.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

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

bool HasGiven(const ExciteOptions& options) {
  return !options.given.logs.empty() || !options.given_calibration.empty();
}

GivenCalibration LearnFromLogs(const Robot& robot, const ExciteOptions& options,
                               const ModelParameters& model) {
  LogReaderOptions reading = options.reading;
  reading.joint_names = robot.JointNames();
  const LogSet logs(options.given.logs, reading, options.given.crop);
  LinearCalibrationOptions linear;
  linear.joint_terms = kTerms;
  linear.bandwidth_hz = options.bandwidth_hz;
  linear.progress = options.progress;
  const LinearCalibration result =
      CalibrateLinear(robot, linear, logs, nullptr);
  if (!result.solved) {
    throw InputError(logs.path(0), "", "",
                     OptionName("given") + ": " + result.reason);
  }
  const Eigen::VectorXd density = ErrorDensity(result);
  return {density, GivenInformation(robot, model, density, options.progress,
                                    Prepare(logs, result.preparation))};
}

// How large errors of the torque are, and what is known already.
void LearnFromGiven(const Robot& robot, const ExciteOptions& options,
                    Design* design) {
  if (!HasGiven(options)) return;
  const GivenCalibration known =
      options.given_calibration.empty()
          ? LearnFromLogs(robot, options, design->model)
          : ReadGivenCalibration(options.given_calibration, robot,
                                 design->model);
  design->known = known.A;
  design->noise = (known.density * options.rate_hz).cwiseSqrt();
}

Design MakeDesign(const Robot& robot, const ExciteOptions& options,
                  const MotionLimits& limits,
                  std::vector<std::string>* assumed) {
  Design design{ModelFor(robot, options.target), {}, {}, {}};
  const int n = robot.num_joints(), m = design.model.size();
  design.known = Eigen::MatrixXd::Zero(m, m);
  design.reference = MakeReferenceScale(
      design.model, limits.velocity.mean() / 2, .5, 1,
      Eigen::VectorXd::Zero(n), design.model.Values(robot));
  design.noise = PerJoint("torque_noise", options.torque_noise, n)
                     .cwiseProduct(design.reference.torque);
  LearnFromGiven(robot, options, &design);
  for (const Link& link : robot.links) {
    if (!link.has_inertial) {
      assumed->push_back("nothing weighs link " + link.name);
    }
  }
  return design;
}

std::vector<const Effect*> EffectsNamed(const std::vector<std::string>& names) {
  std::vector<const Effect*> effects;
  for (const std::string& name : names) {
    effects.push_back(FindEffect(name));
    if (effects.back() != nullptr) continue;
    throw OptionError(OptionName("separate") + ": found '" + name +
                      "', expected names of effects");
  }
  return effects;
}

ExciteSummary Summarise(const ExcitationSummary& design) {
  ExciteSummary summary;
  summary.assumed = design.assumed;
  summary.positive = design.excitation.numbers.size() > 0;
  if (summary.positive) {
    summary.motion = MotionLog(design.excitation, design.options.periods,
                               design.options.rate_hz);
    summary.files.push_back({"trajectory.csv", LogText(summary.motion)});
  }
  summary.json = ToJson(design).dump(2) + "\n";
  summary.files.push_back({"excite.json", summary.json});
  summary.report = FullReport(design);
  return summary;
}

ExciteSummary ForTarget(const Robot& robot, const ExciteOptions& options,
                        const Design& design, const ExcitationOptions& motion,
                        const std::vector<std::string>& assumed) {
  const NamedQuantities quantities =
      MakeDesignQuantities(robot, design.model, kTerms, options.target,
                           options.trust, design.reference, design.known);
  const Excitation excitation =
      DesignExcitation(robot, design.model, quantities.design, motion);
  ExcitationSummary summary{robot, motion, quantities, excitation,
                            {},    assumed, {}};
  if (HasGiven(options)) {
    const int m = design.model.size();
    summary.given_stddev =
        PredictedStddev(quantities.design, Eigen::MatrixXd::Zero(m, m));
  }
  return Summarise(summary);
}

ExciteSummary ForSeparation(const Robot& robot, const ExciteOptions& options,
                            const Design& design,
                            const std::vector<const Effect*>& effects,
                            const ExcitationOptions& motion,
                            const std::vector<std::string>& assumed) {
  const auto question =
      MakeFor(robot, options, OptionName("separate") + ": ", [&] {
        return SeparationQuestion(robot, effects, design.model, motion.limits);
      });
  const EffectSeparation separation =
      SeparateEffects(robot, design.model, question, design.known, motion);
  const NamedQuantities quantities = Quantities(robot, separation);
  ExcitationSummary summary{robot, motion, quantities, separation.motion,
                            {},    assumed, {}};
  summary.alone_stddev.resize(static_cast<long>(separation.sizes.size()));
  for (size_t k = 0; k < separation.sizes.size(); ++k) {
    summary.alone_stddev[static_cast<long>(k)] = separation.sizes[k].alone;
  }
  return Summarise(summary);
}

ExciteSummary ForPoses(const Robot& robot, const ExciteOptions& options) {
  std::vector<std::string> assumed;
  const PostureOptions postures = PostureOptionsFor(robot, options, &assumed);
  if (options.progress) options.progress("designing postures", -1);
  const PostureDesign design = MakeFor(
      robot, options, "", [&] { return DesignPostures(robot, postures); });
  const PostureSummary told{robot, postures, design, assumed};
  ExciteSummary summary;
  summary.poses = design.q;
  summary.assumed = assumed;
  summary.json = ToJson(told).dump(2) + "\n";
  summary.files = {{"postures.csv", PostureText(design)},
                   {"excite.json", summary.json}};
  summary.report = FullReport(told);
  return summary;
}

}  // namespace

ExciteSummary Excite(const Robot& robot, const ExciteOptions& options) {
  if (options.poses) return ForPoses(robot, options);
  std::vector<std::string> assumed;
  ExcitationOptions motion = MotionOptionsFor(robot, options, &assumed);
  const std::vector<const Effect*> effects = EffectsNamed(options.separate);
  if (options.progress) options.progress("preparing the design", -1);
  const Design design = MakeDesign(robot, options, motion.limits, &assumed);
  motion.torque_noise = design.noise;
  return effects.empty()
             ? ForTarget(robot, options, design, motion, assumed)
             : ForSeparation(robot, options, design, effects, motion, assumed);
}

}  // namespace armcal
