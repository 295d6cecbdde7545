#include "model/log_files/array_source.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace armcal::array_source_test {

LogArray Doubles(const std::string& name, long columns,
                 const std::vector<double>& numbers) {
  LogArray array;
  array.name = name;
  array.kind = 'f';
  array.item = 8;
  array.columns = columns;
  array.rows = static_cast<long>(numbers.size()) / columns;
  array.bytes.assign(reinterpret_cast<const char*>(numbers.data()),
                     8 * numbers.size());
  return array;
}

// The names of PACE's logs are columns of ours.
TEST(ArraySource, TakesTheNamesOfOtherToolsLogs) {
  ArraySource source(
      "FILE", {Doubles("time", 1, {0, 1}), Doubles("dof_pos", 2, {1, 2, 3, 4}),
               Doubles("des_dof_pos", 2, {5, 6, 7, 8})});
  std::string_view line;
  ASSERT_TRUE(source.NextLine(&line));
  EXPECT_EQ(line, "\"time\",\"q1\",\"q2\",\"qref1\",\"qref2\"");
  ASSERT_TRUE(source.NextLine(&line));
  ASSERT_TRUE(source.NextLine(&line));
  EXPECT_EQ(line, "1,3,4,7,8");
}

}  // namespace armcal::array_source_test
