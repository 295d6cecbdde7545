#pragma once

#include <functional>

namespace armcal {

// A sequence of tasks that threads share: prepared one after the other, worked
// on by any thread, finished one after the other in the order they were
// prepared in. Each has a slot to itself from its preparation to its end, of
// which there are num_slots(): what they hold is used again and again.
class OrderedWork {
 public:
  OrderedWork();

  int num_slots() const { return slots_; }
  // prepare(slot) is false when there are no more tasks. What a task throws,
  // this throws.
  void Run(const std::function<bool(int slot)>& prepare,
           const std::function<void(int slot)>& work,
           const std::function<void(int slot)>& finish) const;

 private:
  int threads_, slots_;
};

}  // namespace armcal
