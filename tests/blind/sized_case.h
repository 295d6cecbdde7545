#pragma once

#include <string>
#include <vector>

#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"
#include "tests/blind/oracle_gap.h"

namespace armcal {

// A case whose effects have the sizes that its plan asks for, as near as can
// be, and what a label says of them.
struct SizedCase {
  BlindCase blind;
  uint32_t attempt = 0;
  std::vector<EffectSize> sizes;     // of each effect, beside the others
  std::vector<std::string> limits;   // why one is not as planned; empty: it is
  std::optional<OracleGap> oracle;   // nothing where there is no effect
  ScenarioRun training, validation;  // with noise
};

// Of a few draws of the effects' joints and forms the first whose sizes are as
// planned, else the one that is nearest.
SizedCase DrawSizedCase(uint64_t seed, const CasePlan& plan);
// Draws a structured misfit for the case and makes its logs anew with it.
// Sizes and oracle stay those of the plant without it.
void AddMisfit(SizedCase* sized);

}  // namespace armcal
