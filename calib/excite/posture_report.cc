#include "calib/excite/posture_report.h"

#include <algorithm>

#include "calib/numerics/json_figures.h"
#include "model/text/format.h"

namespace armcal {
std::string PostureText(const PostureDesign& design) {
  std::string text;
  for (Eigen::Index j = 0; j < design.q.cols(); ++j) {
    text += (j > 0 ? ",q" : "q") + std::to_string(j + 1);
  }
  for (Eigen::Index k = 0; k < design.q.rows(); ++k) {
    for (Eigen::Index j = 0; j < design.q.cols(); ++j) {
      text += (j > 0 ? "," : "\n") + Format("%.6f", design.q(k, j));
    }
  }
  return text + "\n";
}

std::string FullReport(const PostureSummary& summary) {
  const PostureDesign& design = summary.design;
  std::string text =
      std::to_string(design.q.rows()) + " postures, " +
      (summary.options.instrument == PoseInstrument::kTarget
           ? "the position of a target on the tool measured at each"
           : "the pose of the tool measured at each") +
      "\n\npredicted standard deviations        (as many random postures)\n";
  for (size_t k = 0; k < design.names.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    std::string name = design.names[k];
    name.resize(std::max<size_t>(name.size(), 24), ' ');
    text += "  " + name + Format("%10.3g ", design.stddev[row]) +
            design.units[k] + Format("  (%.3g)\n", design.random_stddev[row]);
  }
  for (const std::string& sentence : summary.assumed) {
    text += "assumed: " + sentence + "\n";
  }
  return text;
}

nlohmann::json ToJson(const PostureSummary& summary) {
  const PostureDesign& design = summary.design;
  nlohmann::json parameters = nlohmann::json::array();
  for (size_t k = 0; k < design.names.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    parameters.push_back(
        {{"name", design.names[k]},
         {"unit", design.units[k]},
         {"stddev", JsonNumber(design.stddev[row])},
         {"random_stddev", JsonNumber(design.random_stddev[row])}});
  }
  return {{"static_poses", design.q.rows()},
          {"criterion_value", JsonNumber(design.criterion)},
          {"random_criterion_value", JsonNumber(design.random_criterion)},
          {"parameters", parameters},
          {"assumed", summary.assumed}};
}

}  // namespace armcal
