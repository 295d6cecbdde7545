#pragma once

#include <string>
#include <vector>

namespace armcal {

// A reader of files that users are sent by others, as fuzzing calls it.
struct FuzzedReader {
  const char* name;  // of the target, and of its folder of seeds: "urdf"
  const char* file;  // what the input's file is called: "input.urdf"
  // Throws InputError for what it refuses; nothing else may escape.
  void (*read)(const std::string& path);
};

// All of them. To add one: a line here, a seed in tests/fuzz/make_seeds.py.
const std::vector<FuzzedReader>& FuzzedReaders();

// Reads `bytes` as a file of its own in `folder`: false where it is refused.
bool ReadsAs(const FuzzedReader& reader, const std::string& folder,
             const char* bytes, std::size_t size);

}  // namespace armcal
