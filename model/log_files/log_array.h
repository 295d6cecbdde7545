#pragma once

#include <string>
#include <vector>

namespace armcal {

// An array of a file, as its bytes are there: of one column, or of two
// dimensions with a row per sample.
struct LogArray {
  std::string name;
  char kind = 0;           // of its numbers: f, i, u; 0: it holds none
  int item = 0;            // bytes of a number: 1, 2, 4 or 8, little-endian
  bool by_column = false;  // the order in memory (Fortran's, MATLAB's)
  long rows = 0, columns = 1;
  std::string bytes;
  size_t begin = 0;                // of the numbers among the bytes
  std::vector<std::string> texts;  // where it holds texts, UTF-8
  std::string why_none;            // it holds no numbers: "of type '|O'"

  // As many digits as bring the same number back.
  void AppendNumber(long row, long column, std::string* line) const;
};

}  // namespace armcal
