#pragma once

#include <cstdint>
#include <fstream>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/ros_bags/bag_file.h"

namespace armcal {

bool IsMcap(std::string_view first_bytes);

// A bag of ROS 2's present format (MCAP 0, mcap.dev/spec), read from its
// beginning to the end of its data, one chunk in memory at a time, so that it
// needs no index. Chunks may be packed by zstd or LZ4.
class McapBag : public BagFile {
 public:
  McapBag(const std::string& path, const Wanted& wanted);

  bool Next(BagMessage* message) override;
  std::vector<BagTopic> Topics() const override;

 private:
  struct Channel {
    const BagTopic* topic;
    bool wanted;
  };
  // The next record of the chunk, or else of the file; false at the end of the
  // data. Records that hold neither messages nor their topics are left out.
  bool NextRecord(int* opcode, std::string_view* content);
  bool NextInChunk(int* opcode, std::string_view* content);
  bool NextInFile(int* opcode, std::string_view* content);
  void OpenChunk(std::string_view content);
  void AddChannel(std::string_view content);
  bool ReadMessage(std::string_view content, BagMessage* message) const;
  [[noreturn]] void Refuse(const std::string& why) const;

  std::string path_;
  Wanted wanted_;
  std::ifstream file_;
  std::uint64_t size_ = 0, at_ = 0;  // of the file
  std::string record_;               // of the file
  std::string chunk_;
  size_t chunk_at_ = 0;
  std::map<int, std::string> schemas_;  // their names
  std::list<BagTopic> topics_;
  std::map<int, Channel> channels_;
};

}  // namespace armcal
