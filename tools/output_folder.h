#pragma once

#include <string>
#include <utility>
#include <vector>

namespace armcal {

// Result files of one run, written at the end of it: all to temporary names
// first, then renamed, so that a run that fails leaves no file behind and an
// older result intact.
class OutputFolder {
 public:
  // Empty `path`: nothing is written.
  explicit OutputFolder(const std::string& path,
                        const std::string& flag = "--out")
      : path_(path), flag_(flag) {}

  void Add(const std::string& name, std::string content);
  // Creates the folder if need be. Throws InputError naming the flag.
  void Write() const { WriteTogether({this}); }
  // All of several folders' files, or none.
  static void WriteTogether(const std::vector<const OutputFolder*>& folders);

 private:
  void WriteTemporaries() const;
  void RenameThem() const;
  void RemoveThem() const;

  std::string path_, flag_;
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace armcal
