#include "calib/excite/excitation_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calib/numerics/json_figures.h"
#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.insert(0, width - text.size(), ' ');
  return text;
}

std::string Rounded(double x, int digits = 3) {
  return std::isfinite(x) ? Format("%.*g", digits, x) : "-";
}

const char* CriterionName(ExcitationCriterion criterion) {
  switch (criterion) {
    case ExcitationCriterion::kD:
      return "D";
    case ExcitationCriterion::kA:
      return "A";
    case ExcitationCriterion::kWorst:
      return "worst";
  }
  return "";
}

// What the motion needs of each joint, at 1 kHz.
struct Needs {
  VectorXd start, lower, upper, velocity, acceleration;
};

Needs NeedsOf(const Excitation& excitation) {
  const Log log = MotionLog(excitation, 1, 1000);
  return {log.q.row(0), log.q.colwise().minCoeff(), log.q.colwise().maxCoeff(),
          log.qd.cwiseAbs().colwise().maxCoeff(),
          log.qdd.cwiseAbs().colwise().maxCoeff()};
}

std::string MotionTable(const ExcitationSummary& summary) {
  const Needs needs = NeedsOf(summary.excitation);
  const MotionLimits& limits = summary.options.limits;
  std::string text =
      "joint                   start       range              limits      "
      "velocity (limit)  acceleration (limit)\n";
  for (int j = 0; j < summary.robot.num_joints(); ++j) {
    const Joint& joint = summary.robot.links[j].joint;
    std::string name = joint.name.substr(0, 16);
    name.resize(16, ' ');
    text += name + Padded(Rounded(needs.start[j]), 9) + " " +
            PositionUnit(joint.type) + "  " +
            Padded(Rounded(needs.lower[j]), 7) + " .. " +
            Padded(Rounded(needs.upper[j]), 6) + "  " +
            Padded(Rounded(limits.lower[j]), 7) + " .. " +
            Padded(Rounded(limits.upper[j]), 6) +
            Padded(Rounded(needs.velocity[j]), 9) + " (" +
            Rounded(limits.velocity[j]) + ")" +
            Padded(Rounded(needs.acceleration[j]), 9) + " (" +
            Rounded(limits.acceleration[j]) + ")\n";
  }
  return text;
}

// The wanted quantities that will be known worst, relative to their scale.
std::string StddevTable(const ExcitationSummary& summary) {
  constexpr int kMost = 12;
  constexpr double kUnseen = 100;  // times what matters
  const DesignQuantities& design = summary.quantities.design;
  const VectorXd& stddev = summary.excitation.stddev;
  std::vector<int> order(design.wanted.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return stddev[design.wanted[a]] / design.scale[a] >
           stddev[design.wanted[b]] / design.scale[b];
  });
  std::string text = "predicted standard deviations, the least certain first\n";
  for (int k = 0; k < std::min<int>(kMost, order.size()); ++k) {
    const int w = design.wanted[order[k]];
    std::string name = summary.quantities.names[w];
    name.resize(std::max<size_t>(name.size(), 32), ' ');
    text += "  " + name + Padded(Rounded(summary.quantities.nominal[w]), 10) +
            " +- " + Rounded(stddev[w]) + " " + summary.quantities.units[w];
    if (summary.given_stddev.size() > 0) {
      const double before = summary.given_stddev[w] / design.scale[order[k]];
      text += before < kUnseen
                  ? "  (before: " + Rounded(summary.given_stddev[w]) + ")"
                  : "  (before: not seen)";
    }
    if (summary.alone_stddev.size() > 0) {
      text +=
          "  (were the others known: " + Rounded(summary.alone_stddev[w]) + ")";
    }
    text += "\n";
  }
  const size_t more = order.size() - std::min<size_t>(kMost, order.size());
  if (more > 0) {
    text += "  and " + std::to_string(more) +
            " that are more certain (excite.json)\n";
  }
  return text;
}

json MatrixJson(const MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      row.push_back(JsonNumber(matrix(i, j)));
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

Log MotionLog(const Excitation& excitation, int periods, double rate_hz) {
  const double duration = periods * excitation.basis.period();
  const int samples = static_cast<int>(std::lround(duration * rate_hz)) + 1;
  const Motion motion =
      Combine(excitation.basis.Units(samples, 1 / rate_hz), excitation.numbers);
  Log log;
  log.t = VectorXd::LinSpaced(samples, 0, (samples - 1) / rate_hz);
  log.q = motion.q;
  log.qd = motion.qd;
  log.qdd = motion.qdd;
  return log;
}

std::string FullReport(const ExcitationSummary& summary) {
  const ExcitationOptions& options = summary.options;
  const Excitation& excitation = summary.excitation;
  if (excitation.numbers.size() == 0) {
    return "No motion: " + excitation.reason + ".\n";
  }
  const double gain = std::exp(excitation.criterion - excitation.start);
  std::string text =
      "A motion of " + NumberText(options.duration_s) + " s" +
      (options.periods > 1
           ? " in " + std::to_string(options.periods) + " equal periods"
           : "") +
      ", " + std::to_string(options.harmonics) + " harmonics of " +
      Rounded(1 / excitation.basis.period()) +
      " Hz, at rest where it begins and ends.\n" + "It uses " +
      Rounded(100 * excitation.used) + " % of what the limits allow" +
      (std::isfinite(excitation.clearance)
           ? ", and nothing comes nearer than " +
                 Format("%.0f mm", 1000 * excitation.clearance)
           : std::string()) +
      ". Standard deviations (criterion " + CriterionName(options.criterion) +
      ") are " + Rounded(gain, 2) + " times those of the best of " +
      std::to_string(options.starts) + " random motions.\n\n" +
      MotionTable(summary) + "\n" + StddevTable(summary);
  if (!summary.assumed.empty())
    text += "\nassumed, where no flag or file says\n";
  for (const std::string& sentence : summary.assumed) {
    text += "  " + sentence + "\n";
  }
  return text;
}

json ToJson(const ExcitationSummary& summary) {
  const ExcitationOptions& options = summary.options;
  const Excitation& excitation = summary.excitation;
  json parameters = json::array();
  const NamedQuantities& quantities = summary.quantities;
  const bool found = excitation.numbers.size() > 0;
  for (size_t k = 0; found && k < quantities.names.size(); ++k) {
    const bool given = summary.given_stddev.size() > 0;
    parameters.push_back(
        {{"name", quantities.names[k]},
         {"unit", quantities.units[k]},
         {"nominal", JsonNumber(quantities.nominal[k])},
         {"stddev", JsonNumber(excitation.stddev[k])},
         {"given_stddev",
          given ? JsonNumber(summary.given_stddev[k]) : json()}});
    if (summary.alone_stddev.size() > 0) {
      parameters.back()["alone_stddev"] = JsonNumber(summary.alone_stddev[k]);
    }
  }
  json joints = json::array();
  const Needs needs = found ? NeedsOf(excitation) : Needs();
  for (int j = 0; found && j < summary.robot.num_joints(); ++j) {
    joints.push_back({{"name", summary.robot.links[j].joint.name},
                      {"lower", needs.lower[j]},
                      {"upper", needs.upper[j]},
                      {"velocity", needs.velocity[j]},
                      {"acceleration", needs.acceleration[j]}});
  }
  json waves;
  if (found) {
    const FourierCoefficients fourier =
        excitation.basis.Fourier(excitation.numbers);
    waves = {{"constant", MatrixJson(fourier.constant.transpose())[0]},
             {"sine", MatrixJson(fourier.sine.transpose())},
             {"cosine", MatrixJson(fourier.cosine.transpose())}};
  }
  return {{"designed", found},
          {"duration", options.duration_s},
          {"periods", options.periods},
          {"harmonics", options.harmonics},
          {"base_frequency", 1 / excitation.basis.period()},
          {"criterion", CriterionName(options.criterion)},
          {"criterion_value", JsonNumber(excitation.criterion)},
          {"random_criterion_value", JsonNumber(excitation.start)},
          {"clearance", JsonNumber(excitation.clearance)},
          {"limits_used", JsonNumber(excitation.used)},
          {"fourier", waves},
          {"joints", joints},
          {"parameters", parameters},
          {"assumed", summary.assumed},
          {"termination",
           {{"converged", excitation.converged},
            {"reason", excitation.reason},
            {"iterations", excitation.iterations}}}};
}

}  // namespace armcal
