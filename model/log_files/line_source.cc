#include "model/log_files/line_source.h"

namespace armcal {

void LineSource::NextLines(std::size_t, std::vector<std::string_view>* lines) {
  lines->clear();
  std::string_view line;
  if (NextLine(&line)) lines->push_back(line);
}

}  // namespace armcal
