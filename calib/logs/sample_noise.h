#pragma once

#include <vector>

#include "calib/logs/sample_pass.h"

namespace armcal {

// The noise of single torque samples of one joint, and what tells it: motion
// that was done twice (what the model lacks is in both, and falls out of their
// difference), else the scatter while the arm stands, else the residual, which
// holds what the model lacks as well.
struct SampleNoise {
  enum class Source { kRepeats, kStandstill, kResidual };
  Source source = Source::kResidual;
  double stddev = 0;  // N m or N, robust
  long samples = 0;   // it comes from
};

const char* NoiseSourceName(SampleNoise::Source source);

// Per joint, `outliers` left out (none: an empty list of lists). Repeats are
// looked for in and across logs, in the first 60000 samples (a share for each
// log). One pass at full rate. Estimates do not weigh by it: the scatter of
// equations, which holds model errors and noise of the positions too, is what
// weighs them.
std::vector<SampleNoise> EstimateSampleNoise(const OutlierLists& outliers,
                                             SamplePass* pass);

}  // namespace armcal
