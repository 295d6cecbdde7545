#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/text/document.h"

namespace armcal {

// A file that a result came from, with what `sha256sum` says of it.
struct SourceFile {
  std::string path;
  std::string sha256;
  long bytes = 0;
};
// Throws InputError where it cannot be read.
SourceFile HashFile(const std::string& path);
// Of a text in memory: of its bytes.
SourceFile HashDocument(const Document& document);

// What report.html shows. Everything but `result` may be empty.
struct ReportContent {
  std::string command;    // "calibrate", "diagnose", "inspect" ..
  std::string robot;      // its name
  nlohmann::json result;  // the command's own JSON
  nlohmann::json torques = nlohmann::json::array();  // TracesJson
  nlohmann::json skeleton;                           // SkeletonJson
  nlohmann::json extra = nlohmann::json::object();   // of one command only
  std::vector<std::string> arguments;                // the command line
  std::vector<SourceFile> files;
  std::string source_hash;  // of armcal (tools/source_hash.h)
};

// The command line, the versions and the files, which the page ends with.
nlohmann::json ProvenanceJson(const ReportContent& content);

// A page in one file: no network, scripts only those whose hashes its content
// security policy names, and names of joints or files as text, never as HTML.
// The same content gives the same bytes.
std::string ReportPage(const ReportContent& content);

}  // namespace armcal
