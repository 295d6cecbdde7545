#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace armcal {

// Writes bytes as they are to a new file of the running test; returns its path.
inline std::string WriteFile(const std::string& bytes,
                             const std::string& name = "log.csv") {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string test_name =  // "Suite_Test/0" of a parameterised one
      std::string(test->test_suite_name()) + "_" + test->name();
  std::replace(test_name.begin(), test_name.end(), '/', '_');
  const std::string path = testing::TempDir() + test_name + "_" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

// The gzip stream that `gzip` would make of a text.
inline std::string Gzip(const std::string& text) {
  z_stream stream = {};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, MAX_WBITS + 16, 8,
                         Z_DEFAULT_STRATEGY),
            Z_OK);
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(&bytes[0]);
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

// The message of the exception that `action` throws, with `path` as FILE;
// empty where it throws none.
template <typename Exception, typename Action>
std::string MessageOf(const std::string& path, const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    std::string message = error.what();
    const size_t at = message.find(path);
    return at == message.npos ? message
                              : message.replace(at, path.size(), "FILE");
  }
  return "";
}

}  // namespace armcal
