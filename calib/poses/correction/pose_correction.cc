#include "calib/poses/correction/pose_correction.h"

#include "calib/numerics/json_figures.h"
#include "model/text/format.h"

namespace armcal {

using nlohmann::json;

namespace {

// Rows of the table: four nodes for each of six joints.
constexpr long kTableRows = 4096;

json ErrorJson(const CorrectionError& error) {
  return {{"median", JsonNumber(error.median)},
          {"p95", JsonNumber(error.p95)},
          {"most", JsonNumber(error.most)}};
}

// mm; what is less than the solution of equations is known to is not shown.
std::string InMm(double x) {
  return x < 1e-6 ? "<0.001" : Format("%.3g", 1e3 * x);
}

std::string ErrorText(const char* name, const CorrectionError& error) {
  return Format("  %-32s%12s%12s%12s\n", name, InMm(error.median).c_str(),
                InMm(error.p95).c_str(), InMm(error.most).c_str());
}

}  // namespace

PoseCorrection CorrectFromPoses(const PoseMeasurements& measured,
                                const PoseModel& model,
                                const PoseMeasurements* held_out) {
  PoseCorrection correction = {ActualArm(model), {}, {}, {}};
  Eigen::MatrixX2d range(measured.q.cols(), 2);
  range << measured.q.colwise().minCoeff().transpose(),
      measured.q.colwise().maxCoeff().transpose();
  correction.table = MakeCorrectionTable(correction.arm, range, kTableRows);
  correction.errors =
      MeasureCorrection(correction.arm, correction.table, range);
  if (held_out != nullptr) {
    correction.check = CheckCorrection(correction.arm, *held_out);
  }
  return correction;
}

bool TableHelps(const CorrectionErrors& errors) {
  return errors.by_table.median < errors.before.median &&
         errors.by_table.p95 < errors.before.p95;
}

std::string CorrectionText(const PoseCorrection& correction, double held_out) {
  const CorrectionErrors& errors = correction.errors;
  std::string text =
      "\nfrom the fitted arm in 1000 postures, mm median        95 %     at "
      "most\n" +
      ErrorText("as commanded", errors.before) +
      ErrorText("with correction.c", errors.command);
  if (TableHelps(errors)) {
    text += ErrorText("with correction.csv", errors.by_table);
  }
  text += Format(
      "  these are distances between models; the fitted arm itself is %.3g mm "
      "rms from held-out poses\n",
      1e3 * held_out);
  if (!TableHelps(errors)) {
    text += Format(
        "  no correction.csv: a table of %ld rows is too coarse for these "
        "joints' ranges (%.3g mm median with it)\n",
        kTableRows, 1e3 * errors.by_table.median);
  }
  if (correction.check) {
    text += Format(
        "  %d held-out poses: %.4g mm rms by the robot file, %.4g by what was "
        "found\n",
        correction.check->poses, 1e3 * correction.check->before,
        1e3 * correction.check->after);
  }
  for (const std::string& name : correction.arm.left_out()) {
    text += "  not part of them, since it is none of the arm's: " + name + "\n";
  }
  return text;
}

json CorrectionJson(const PoseCorrection& correction) {
  const CorrectionErrors& errors = correction.errors;
  json nodes = json::array();
  for (const Eigen::VectorXd& joint : correction.table.nodes) {
    nodes.push_back(joint.size());
  }
  json result = {{"before", ErrorJson(errors.before)},
                 {"command", ErrorJson(errors.command)},
                 {"table",
                  {{"nodes", nodes},
                   {"command", ErrorJson(errors.by_table)},
                   {"forward", ErrorJson(errors.forward_table)}}},
                 {"left_out", correction.arm.left_out()},
                 {"validation", nullptr}};
  if (correction.check) {
    result["validation"] = {{"poses", correction.check->poses},
                            {"before", JsonNumber(correction.check->before)},
                            {"after", JsonNumber(correction.check->after)}};
  }
  return result;
}

}  // namespace armcal
