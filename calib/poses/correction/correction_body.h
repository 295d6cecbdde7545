#pragma once

namespace armcal {

// The part of CorrectionCode() that is the same for all arms: it follows the
// numbers of one.
extern const char kCorrectionBody[];

}  // namespace armcal
