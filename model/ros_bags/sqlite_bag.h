#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/ros_bags/bag_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace armcal {

bool IsSqlite(std::string_view first_bytes);

// A bag of rosbag2's first format (.db3): the tables `topics` and `messages` of
// a data base of SQLite.
class SqliteBag : public BagFile {
 public:
  SqliteBag(const std::string& path, const Wanted& wanted);

  bool Next(BagMessage* message) override;
  std::vector<BagTopic> Topics() const override;

 private:
  struct Close {
    void operator()(sqlite3* base) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  void Open();
  void CheckTables();
  void ReadTopics(const Wanted& wanted);
  Statement Prepare(const std::string& sql);
  bool Step(const Statement& statement);
  // A column of the row that the last Step() found.
  std::string_view Bytes(const Statement& row, int column) const;
  [[noreturn]] void Refuse();

  std::string path_;
  std::unique_ptr<sqlite3, Close> base_;
  std::map<std::int64_t, BagTopic> topics_;  // by number
  Statement messages_;                       // null: none is wanted
};

}  // namespace armcal
