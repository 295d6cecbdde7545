#pragma once

#include <string>
#include <vector>

#include "tools/flag_values.h"

namespace armcal {

// --export: what of a robot is written.
struct ExportChoice {
  std::vector<std::string> formats;
  int samples = 0;  // robots drawn from a calibration's posterior
};
// UsageError for a word that is no format and no `samples:N`.
ExportChoice ExportFromFlags(const FlagValues& flags);
// The same of a command that has no posterior to draw from.
std::vector<std::string> ExportFormatsFromFlags(const FlagValues& flags);

}  // namespace armcal
