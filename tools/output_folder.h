#pragma once

#include <string>
#include <utility>
#include <vector>

namespace armcal {

// Result files of one run, written at the end of it: a run that fails, is
// interrupted or killed leaves an older result intact, and the new one takes
// its place at one moment (StagedFiles). Of runs that write to one folder at
// once, one does after the other.
class OutputFolder {
 public:
  // Empty `path`: nothing is written.
  explicit OutputFolder(const std::string& path,
                        const std::string& flag = "--out");

  // `name` may be in a folder of its own, "samples/robot_1.urdf": files there
  // whose names begin alike ("robot_") and that are not written again go, so
  // that no older ones are among the new.
  void Add(const std::string& name, std::string content);
  // Name and content.
  const std::vector<std::pair<std::string, std::string>>& files() const {
    return files_;
  }
  // All of several folders' files, or none; those of a folder at one moment, of
  // several one right after the other. Creates the folders if need be. Throws
  // InputError naming the flag.
  static void WriteTogether(std::vector<OutputFolder>* folders);

 private:
  class Place;

  std::string path_, flag_;
  std::vector<std::pair<std::string, std::string>> files_;
};

}  // namespace armcal
