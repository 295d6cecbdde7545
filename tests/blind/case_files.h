#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "tests/blind/blind_case.h"

namespace armcal {

// Cases on disk: a folder of logs each, and a label elsewhere, which is written
// last, so that a case with a label is complete.

// "case_0007".
std::string CaseName(std::uint32_t index);
// By a temporary name first: a run may be interrupted.
void WriteText(const std::filesystem::path& path, const std::string& text);

// What is wrong with what a writer of cases was asked for; empty where nothing.
std::string WhyNotWritten(const std::string& set, std::uint32_t seed,
                          const std::filesystem::path& logs,
                          const std::filesystem::path& labels);
// "calibration", "evaluation".
BlindSet BlindSetNamed(const std::string& name);

}  // namespace armcal
