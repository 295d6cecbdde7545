#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace armcal {

struct BagTopic {
  std::string name;
  std::string type;      // "sensor_msgs/msg/JointState"
  std::string encoding;  // "cdr" in ROS 2
};

struct BagMessage {
  const BagTopic* topic = nullptr;
  std::int64_t received = 0;  // ns, by the recorder's clock
  std::string_view data;      // lives until the next call
};

// The messages of one file of a ROS 2 bag in the order of the file, read one by
// one. All throw InputError for a file that is damaged or cut off.
class BagFile {
 public:
  // Messages of other topics are stepped over.
  using Wanted = std::function<bool(const BagTopic&)>;
  virtual ~BagFile() = default;

  // The next message that is wanted; false at the end.
  virtual bool Next(BagMessage* message) = 0;
  // At the end: all of them.
  virtual std::vector<BagTopic> Topics() const = 0;
};

}  // namespace armcal
