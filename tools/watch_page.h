#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calib/watch/event.h"
#include "model/robot/robot.h"

namespace armcal {

// A page on this machine (127.0.0.1, nobody else is answered) that shows a log
// being watched: each joint's residual with its limit, what has changed, what
// was told. It asks for /state.json a few times a second.
class WatchPage {
 public:
  // Port 0: any that is free. Throws InputError where it is not to be had.
  WatchPage(const Robot& robot, int port);
  ~WatchPage();

  int port() const;
  void Add(const WatchEvent& event);
  void Show(const WatchState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armcal
