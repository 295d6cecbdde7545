#pragma once

#include <string>

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// What of a diagnosis' sentence names effects, without its full stop. With a
// reference effects are changes since it; without one they are what the model
// lacks: joints' terms that the file has for none, which the refit has as well,
// and then what a refit cannot have. What touched the arm is told first.
std::string NamedEffects(const GapDiagnosis& diagnosis);

// The sentence on what has several names, none of which is probable enough;
// empty where nothing has.
std::string AlikeEffects(const GapDiagnosis& diagnosis);

// The same beside effects that are named, with a blank before it.
std::string AlikeBesides(const GapDiagnosis& diagnosis);

}  // namespace armcal
