#include "calib/numerics/thread_limit.h"

#include <oneapi/tbb/global_control.h>

namespace armcal {

using Control = tbb::global_control;

ThreadLimit::ThreadLimit(int threads)
    : control_(threads == 0
                   ? nullptr
                   : new Control(Control::max_allowed_parallelism, threads)) {}

ThreadLimit::~ThreadLimit() { delete static_cast<Control*>(control_); }

int ThreadLimit::Active() {
  return static_cast<int>(
      Control::active_value(Control::max_allowed_parallelism));
}

}  // namespace armcal
