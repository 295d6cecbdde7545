#include "model/ros_bags/message_header.h"

#include <string>

namespace armcal {

bool IsMessageType(std::string_view type, std::string_view package,
                   std::string_view name) {
  const std::string stem(package), end(name);
  return type == stem + "/msg/" + end || type == stem + "/" + end;
}

std::int64_t ReadStamp(CdrReader* cdr) {
  constexpr std::int64_t kBillion = 1000000000;
  const std::int64_t seconds = cdr->Signed();
  const std::uint32_t nanoseconds = cdr->Unsigned();
  if (nanoseconds >= kBillion) {
    throw CdrError("has " + std::to_string(nanoseconds) +
                   " ns in its stamp, expected less than a second");
  }
  cdr->Text();  // the frame
  return seconds * kBillion + nanoseconds;
}

}  // namespace armcal
