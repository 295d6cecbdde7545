#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace armcal {

// A file that a result is written to.
struct ResultFile {
  std::string name;
  std::string content;
};

// What a function has to say to a person, to a program and in files.
struct Summary {
  bool positive = true;  // the verdict; false: exit code 1 of the command
  std::string brief;     // a sentence or two; empty where there is none
  std::string report;    // what a person reads
  std::string json;      // the same for a program; docs have its keys
  std::vector<ResultFile> files;  // what the command writes, the JSON among it
};

// Prints the report.
std::ostream& operator<<(std::ostream& stream, const Summary& summary);

// Writes the files to a folder, which is made where it is missing. Throws
// InputError where that is not possible.
void WriteFiles(const Summary& summary, const std::string& folder);

}  // namespace armcal
