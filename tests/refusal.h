#pragma once

// What the reader of a robot file says about a text.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "model/input_error.h"

namespace armcal {

// A change of a text and what is then refused.
struct Case {
  const char* old_text;  // the first such is replaced
  const char* new_text;
  const char* message;
};

inline std::string Changed(std::string text, const Case& c) {
  const size_t at = text.find(c.old_text);
  EXPECT_NE(at, std::string::npos) << c.old_text;
  return text.replace(at, std::string(c.old_text).size(), c.new_text);
}

// What `read` refuses about `text` in the file `path`, without that file's
// name; empty: nothing. One line.
template <typename Read>
std::string RefusalOf(const std::string& path, const std::string& text,
                      const Read& read) {
  std::ofstream(path, std::ios::binary) << text;
  std::string message;
  try {
    read(path);
  } catch (const InputError& error) {
    message = error.what();
    EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    message.erase(0, path.size() + 2);
  }
  std::remove(path.c_str());
  return message;
}

}  // namespace armcal
