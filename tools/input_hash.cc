#include "tools/input_hash.h"

#include <string_view>

#include "calib/numerics/sha256.h"

namespace armcal {
namespace {

SourceFile HashArrays(const LogSource& log) {
  SourceFile source{log.name, "", 0};
  Sha256 hash;
  for (const LogArray& array : *log.arrays) {
    hash.Add(array.name + " " + std::to_string(array.rows) + " " +
             std::to_string(array.columns) + "\n");
    const std::string_view bytes =
        std::string_view(array.bytes).substr(array.begin);
    hash.Add(bytes);
    source.bytes += static_cast<long>(bytes.size());
  }
  source.sha256 = HexText(hash.Value());
  return source;
}

}  // namespace

SourceFile HashInput(const CommandInput& input, const std::string& name) {
  const auto log = input.logs.find(name);
  return log == input.logs.end() ? HashFile(name) : HashArrays(log->second);
}

}  // namespace armcal
