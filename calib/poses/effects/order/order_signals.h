#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/effects/effect.h"

namespace armcal {

inline constexpr char kRepeatEarlyPoses[] =
    "the first poses again at the end, and others in another order";

// Places of a step at a grid of poses, of a window between two of them, for
// each of `parts`; searches refine them pose by pose.
std::vector<PosePlace> StepPlaces(const PoseCampaign& campaign,
                                  const std::vector<int>& parts);
std::vector<PosePlace> WindowPlaces(const PoseCampaign& campaign,
                                    const std::vector<int>& parts);
// In how many places a step or a window can be.
double StepCount(const PoseCampaign& campaign);
double WindowCount(const PoseCampaign& campaign);
// A drift that goes smoothly through its values at `knots` poses evenly over
// the order (a cubic spline; two: a line), or with 1 one that settles, 1 -
// exp(-4 t), over the order t from 0 to 1, as what warms.
std::vector<PosePlace> DriftPlaces(const PoseCampaign& campaign,
                                   const std::vector<int>& parts,
                                   const std::vector<int>& knots);

// 1 from place.begin on, and up to place.end where it has one; else 0.
Eigen::VectorXd WindowSignal(int poses, const PosePlace& place);
// A column per knot but the first, which is where all begins: cardinal splines
// over the order, 1 at their knot and 0 at the others. (Hat functions miss a
// curve between knots by h^2 / 8 of its second derivative, which was more than
// the noise of drifts that were 20 times as large.)
Eigen::MatrixXd DriftSignals(int poses, const PosePlace& place);

// What can move of a tool: its place, its pose, each target alone (-1, ...).
std::vector<int> ToolParts(const PoseCampaign& campaign);

// Terms along three axes and about them with 6 `parts`, for each column of
// `signals`; of a single target with `parts` -1, -2, ...
std::vector<PoseTerm> MovedBody(PoseTerm::Acts acts, int parts,
                                const Eigen::MatrixXd& signals);

}  // namespace armcal
