#pragma once

#include <string>
#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// Poses fitted alone, from their start values: first the instrument's frame,
// then what `refine` asks for and the poses can tell.
struct PoseSolution {
  std::string refusal;  // why there is none; empty: solved
  PoseUnknowns unknowns;
  std::vector<bool> free;         // of the geometry's parameters
  std::vector<std::string> held;  // sentences
  std::vector<double> before;     // distances, m, with only the frame fitted
  PoseUnknowns frame;             // as they are then
  std::vector<bool> frame_free;
};
PoseSolution SolvePoses(const PoseMeasurements& measured, RefineGeometry refine,
                        PoseFit* fit);

}  // namespace armcal
