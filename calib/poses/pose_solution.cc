#include "calib/poses/pose_solution.h"

#include "calib/poses/identifiability.h"
#include "calib/poses/start.h"
#include "calib/poses/touch_scale.h"

namespace armcal {

// The frame is fitted first, with the geometry of the file: from a rough start
// the geometry would take up what a wrong frame leaves.
PoseSolution SolvePoses(const PoseMeasurements& measured, RefineGeometry refine,
                        PoseFit* fit) {
  PoseSolution solution;
  const std::vector<int> rows = fit->AllRows();
  solution.unknowns = StartPoses(fit->geometry(), measured);
  fit->EstimateNoise(std::vector<bool>(fit->geometry().size(), false),
                     solution.unknowns);
  const auto solve = [&](RefineGeometry what, const char* failure) {
    solution.held.clear();
    solution.free = HoldUnseen(*fit, fit->Wanted(what), rows, solution.unknowns,
                               &solution.held);
    solution.refusal = fit->WhyTooFew(solution.free);
    if (!solution.refusal.empty()) return false;
    if (!fit->SolveWithNoise(solution.free, rows, &solution.unknowns)) {
      solution.refusal = failure;
    }
    return solution.refusal.empty();
  };
  if (!solve(RefineGeometry::kNothing,
             "the instrument's frame cannot be found")) {
    return solution;
  }
  solution.before = fit->Distances(rows, solution.unknowns);
  solution.frame = solution.unknowns;
  solution.frame_free = solution.free;
  const bool solved = solve(refine, "the geometry cannot be solved for");
  if (solved && !measured.touched.empty()) {
    SetScaleByFile(*fit, measured, solution.free, &solution.unknowns);
  }
  return solution;
}

}  // namespace armcal
