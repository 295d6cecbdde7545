#pragma once

#include "tests/blind/blind_label.h"

namespace armcal {

// Real logs of other days differ from their reference whatever a case put into
// them. What the diagnosis of the untouched log claims is told apart from what
// the case hides: those claims do not count, right or wrong. Where the truth is
// among them it counts if its size went from the untouched log's by half of
// what the case put in at least, and that way.
//
// `untouched`: the same diagnoser's answer to the log as it is.
BlindAnswer WithoutDayChanges(const BlindLabel& label, BlindAnswer answer,
                              const BlindAnswer& untouched);

}  // namespace armcal
