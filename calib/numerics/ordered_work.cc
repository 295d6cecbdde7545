#include "calib/numerics/ordered_work.h"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "calib/numerics/thread_limit.h"

namespace armcal {
// Two tasks for each thread, so that none waits for another's end.
OrderedWork::OrderedWork()
    : threads_(ThreadLimit::Active()),
      slots_(threads_ == 1 ? 1 : 2 * threads_) {}

void OrderedWork::Run(const std::function<bool(int slot)>& prepare,
                      const std::function<void(int slot)>& work,
                      const std::function<void(int slot)>& finish) const {
  if (threads_ == 1) {
    while (prepare(0)) {
      work(0);
      finish(0);
    }
    return;
  }
  long task = 0;
  // Tasks end in order, so the slot of the task num_slots() ago is free.
  const auto next = [&](tbb::flow_control& control) {
    const int slot = static_cast<int>(task++ % slots_);
    if (!prepare(slot)) control.stop();
    return slot;
  };
  const auto done = [&](int slot) {
    work(slot);
    return slot;
  };
  tbb::task_arena arena(threads_);
  arena.execute([&] {
    using tbb::filter_mode;
    tbb::parallel_pipeline(
        slots_,
        tbb::make_filter<void, int>(filter_mode::serial_in_order, next) &
            tbb::make_filter<int, int>(filter_mode::parallel, done) &
            tbb::make_filter<int, void>(filter_mode::serial_in_order, finish));
  });
}

}  // namespace armcal
