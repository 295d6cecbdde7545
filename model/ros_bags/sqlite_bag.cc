#include "model/ros_bags/sqlite_bag.h"

#include <sqlite3.h>

#include <filesystem>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// A file that no one writes: SQLite then leaves nothing beside it, also in
// folders that may not be written to. Messages that a recorder left in a -wal
// file would be lost.
std::string Immutable(const std::string& path) {
  std::error_code error;
  if (std::filesystem::exists(path + "-wal", error)) return path;
  std::string uri = "file:";
  for (const char c : path) {
    switch (c) {
      case '%':
        uri += "%25";
        break;
      case '?':
        uri += "%3f";
        break;
      case '#':
        uri += "%23";
        break;
      default:
        uri += c;
    }
  }
  return uri + "?immutable=1";
}

}  // namespace

bool IsSqlite(std::string_view first_bytes) {
  return first_bytes.substr(0, 15) == "SQLite format 3";
}

void SqliteBag::Close::operator()(sqlite3* base) const { sqlite3_close(base); }

void SqliteBag::Close::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteBag::SqliteBag(const std::string& path, const Wanted& wanted)
    : path_(path) {
  Open();
  CheckTables();
  ReadTopics(wanted);
}

void SqliteBag::Open() {
  constexpr int kMostBytes = 64 << 20;  // of a message
  sqlite3* base = nullptr;
  const int code =
      sqlite3_open_v2(Immutable(path_).c_str(), &base,
                      SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  base_.reset(base);
  if (code != SQLITE_OK) Refuse();
  // What a file says must not run.
  sqlite3_db_config(base, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(base, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(base, SQLITE_LIMIT_LENGTH, kMostBytes);
}

// Views and virtual tables of these names would run what they like.
void SqliteBag::CheckTables() {
  const Statement count = Prepare(
      "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND "
      "name IN ('topics', 'messages') AND sql LIKE 'CREATE TABLE%'");
  if (Step(count) && sqlite3_column_int(count.get(), 0) == 2) return;
  throw InputError(path_, "", "",
                   "is an SQLite data base, but not a bag of ROS 2: expected "
                   "the tables topics and messages");
}

void SqliteBag::ReadTopics(const Wanted& wanted) {
  const Statement rows =
      Prepare("SELECT id, name, type, serialization_format FROM topics");
  std::string ids;
  while (Step(rows)) {
    const std::int64_t id = sqlite3_column_int64(rows.get(), 0);
    const BagTopic& topic =
        topics_[id] = {std::string(Bytes(rows, 1)), std::string(Bytes(rows, 2)),
                       std::string(Bytes(rows, 3))};
    if (wanted(topic)) ids += (ids.empty() ? "" : ",") + std::to_string(id);
  }
  if (ids.empty()) return;
  messages_ = Prepare(
      "SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN (" +
      ids + ") ORDER BY id");
}

bool SqliteBag::Next(BagMessage* message) {
  if (!messages_ || !Step(messages_)) return false;
  const std::int64_t id = sqlite3_column_int64(messages_.get(), 0);
  message->topic = &topics_.at(id);
  message->received = sqlite3_column_int64(messages_.get(), 1);
  message->data = Bytes(messages_, 2);
  return true;
}

std::vector<BagTopic> SqliteBag::Topics() const {
  std::vector<BagTopic> topics;
  for (const auto& [id, topic] : topics_) topics.push_back(topic);
  return topics;
}

SqliteBag::Statement SqliteBag::Prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(base_.get(), sql.c_str(), -1, &statement, nullptr) !=
      SQLITE_OK) {
    Refuse();
  }
  return Statement(statement);
}

bool SqliteBag::Step(const Statement& statement) {
  const int code = sqlite3_step(statement.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) Refuse();
  return code == SQLITE_ROW;
}

std::string_view SqliteBag::Bytes(const Statement& row, int column) const {
  const void* const bytes = sqlite3_column_blob(row.get(), column);
  return {static_cast<const char*>(bytes),
          bytes == nullptr
              ? 0
              : static_cast<size_t>(sqlite3_column_bytes(row.get(), column))};
}

void SqliteBag::Refuse() {
  throw InputError(
      path_, "", "",
      "SQLite says: " +
          OneLine(base_ ? sqlite3_errmsg(base_.get()) : "out of memory") +
          "; expected a whole bag of ROS 2");
}

}  // namespace armcal
