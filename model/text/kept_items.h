#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "model/text/memory_budget.h"

namespace armcal {

// What one pass makes, for the passes after it: all of it, or nothing where it
// does not fit the budget.
template <class Item>
class KeptItems {
 public:
  explicit KeptItems(std::shared_ptr<MemoryBudget> budget)
      : share_(std::move(budget)) {}

  // Whether the items of a whole pass are here.
  bool whole() const { return state_ == State::kWhole; }
  std::vector<Item>& items() { return items_; }

  // A pass that makes items: Begin(), Add() for each, End(). Items of a pass
  // that did not come to its end are gone.
  void Begin() {
    Drop();
    if (state_ != State::kTooLarge) state_ = State::kFilling;
  }
  // Where the item is from now on: moved to its place, or left where it is.
  Item* Add(Item* item, std::size_t bytes) {
    if (state_ != State::kFilling) return item;
    if (!share_.Take(bytes)) {
      Drop();
      ReturnFreedMemory();
      state_ = State::kTooLarge;
      return item;
    }
    items_.push_back(std::move(*item));
    return &items_.back();
  }
  void End() {
    if (state_ == State::kFilling) state_ = State::kWhole;
  }
  // The next pass makes other items, which may fit.
  void Forget() {
    Drop();
    state_ = State::kNone;
  }

 private:
  enum class State { kNone, kFilling, kWhole, kTooLarge };

  void Drop() {
    items_ = {};
    share_.GiveBack();
  }

  MemoryShare share_;
  std::vector<Item> items_;
  State state_ = State::kNone;
};

}  // namespace armcal
