#pragma once

#include <string>
#include <utility>
#include <vector>

namespace armcal {

// Result files of one run, written at the end of it: all to temporary names
// first, then renamed, so that a run that fails or is interrupted leaves no
// file behind and an older result intact. Of runs that write to one folder at
// once, one after the other renames its files.
class OutputFolder {
 public:
  // Empty `path`: nothing is written.
  explicit OutputFolder(const std::string& path,
                        const std::string& flag = "--out");

  void Add(const std::string& name, std::string content);
  // Name and content.
  const std::vector<std::pair<std::string, std::string>>& files() const {
    return files_;
  }
  // All of several folders' files, or none. Creates the folders if need be.
  // Throws InputError naming the flag.
  static void WriteTogether(std::vector<OutputFolder>* folders);

 private:
  class Lock;  // of a folder, while files are renamed

  std::string Temporary(const std::string& name) const;
  void WriteTemporaries();
  void RenameThem() const;
  void RemoveThem() const;

  std::string path_, flag_;
  std::string suffix_;             // of temporary names, this run's own
  std::vector<std::string> made_;  // folders that were not there, outer first
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace armcal
