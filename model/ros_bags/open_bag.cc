#include "model/ros_bags/open_bag.h"

#include "model/ros_bags/mcap_bag.h"
#include "model/ros_bags/sqlite_bag.h"
#include "model/text/first_bytes.h"

namespace armcal {

bool IsBagFile(std::string_view first_bytes) {
  return IsSqlite(first_bytes) || IsMcap(first_bytes);
}

std::unique_ptr<BagFile> OpenBagFile(const std::string& path,
                                     const BagFile::Wanted& wanted) {
  if (IsMcap(FirstBytes(path))) return std::make_unique<McapBag>(path, wanted);
  return std::make_unique<SqliteBag>(path, wanted);
}

}  // namespace armcal
