#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/poses/diagnosis/finding.h"

namespace armcal {

// One sentence: what was found, how far it shrinks the error, what is left.
std::string PoseSentence(const PoseDiagnosis& diagnosis);
// What a person reads, a screen of it.
std::string PoseDiagnosisReport(const Robot& robot,
                                const PoseMeasurements& measured,
                                const PoseDiagnosis& diagnosis);
// pose_diagnosis.json (docs/diagnose.md).
nlohmann::json PoseDiagnosisJson(const Robot& robot,
                                 const PoseMeasurements& measured,
                                 const PoseDiagnosis& diagnosis);

}  // namespace armcal
