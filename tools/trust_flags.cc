#include "tools/trust_flags.h"

#include <gflags/gflags.h>

#include <cmath>
#include <string>

#include "model/text/input_text.h"
#include "tools/usage_error.h"

DEFINE_double(trust, 0.5,
              "relative standard deviation of the file's inertias (diagnose: "
              "0.05 without --reference)");
DEFINE_double(
    length_trust, 0.01,
    "`M` standard deviation of the robot file's lengths where they are "
    "refined, m");
DEFINE_double(
    angle_trust, 0.02,
    "`RAD` standard deviation of the robot file's angles where they are "
    "refined, and of the base's tilt, rad");

namespace armcal {
namespace {

double PositiveFlag(const std::string& name, double value,
                    const std::string& expected) {
  if (value > 0 && std::isfinite(value)) return value;
  throw UsageError("--" + name + ": found '" + NumberText(value) +
                   "', expected " + expected + " above 0");
}

}  // namespace

ArmTrust TrustFromFlags(const FlagValues& flags) {
  return {PositiveFlag("trust", flags.Number("trust"),
                       "a relative standard deviation"),
          PositiveFlag("length_trust", flags.Number("length_trust"),
                       "a standard deviation in m"),
          PositiveFlag("angle_trust", flags.Number("angle_trust"),
                       "a standard deviation in rad")};
}

}  // namespace armcal
