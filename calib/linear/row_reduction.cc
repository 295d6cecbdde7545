#include "calib/linear/row_reduction.h"

#include <algorithm>

#include "problems/make_rows.h"

namespace armcal {

long RowsPerLeaf(const RowOptions& options) {
  return options.identification == Identification::kDifferential
             ? TriangularFactor::kLeafRows
             : 64;
}

namespace {

std::vector<int> RowSizes(const ModelParameters& parameters) {
  std::vector<int> sizes;
  for (int i = 0; i < parameters.num_joints(); ++i) {
    sizes.push_back(static_cast<int>(parameters.row_columns(i).size()));
  }
  return sizes;
}

}  // namespace

RowReduction::RowReduction(const ModelParameters& parameters)
    : RowReduction(RowSizes(parameters)) {}

RowReduction::RowReduction(const std::vector<int>& columns)
    : slots_(work_.num_slots()) {
  for (Slot& slot : slots_) {
    for (const int size : columns) slot.leaves.emplace_back(size);
  }
}

void RowReduction::Add(const IdentificationRows& rows,
                       BlockTriangularFactor* factor) {
  Run(
      rows, factor->leaf_rows(),
      [&](auto* leaves) { factor->TakeLeaves(leaves); },
      [&](int slot) { factor->PutLeaves(&slots_[slot].leaves); },
      [](const ReducedRows&) {});
}

void RowReduction::Add(const IdentificationRows& rows,
                       std::vector<TriangularFactor>* factors,
                       const std::function<void(const ReducedRows&)>& change,
                       const std::function<void(int slot)>& finish) {
  Run(
      rows, factors->front().leaf_rows(),
      [&](auto* leaves) {
        for (size_t i = 0; i < factors->size(); ++i) {
          (*factors)[i].TakeLeaf(&(*leaves)[i]);
        }
      },
      [&](int slot) {
        for (size_t i = 0; i < factors->size(); ++i) {
          (*factors)[i].PutLeaf(&slots_[slot].leaves[i]);
        }
        finish(slot);
      },
      change);
}

// QR of tall matrices in leaves (Demmel, Grigori, Hoemmen & Langou 2012, SIAM
// J. Sci. Comput. 34): threads triangularise leaves of rows by themselves, and
// the small triangles are put together in the order of rows. Leaves begin and
// end at the same rows whatever the threads; hence the same bits. The first
// leaf goes on with the one that earlier rows have left half full.
template <class Take, class Put, class Change>
void RowReduction::Run(const IdentificationRows& rows, long leaf_rows,
                       const Take& take, const Put& put, const Change& change) {
  long next = 0;
  const auto prepare = [&](int k) {
    if (next == rows.size()) return false;
    Slot& slot = slots_[k];
    long under_way = 0;
    if (next == 0) {
      take(&slot.leaves);
      under_way = slot.leaves[0].rows();
    }
    slot.begin = next;
    next = std::min(rows.size(), next + leaf_rows - under_way);
    slot.end = next;
    return true;
  };
  const auto reduce = [&](int k) {
    Slot& slot = slots_[k];
    std::vector<double*> out(slot.leaves.size());
    for (long row = slot.begin; row < slot.end;) {
      const long count = std::min(slot.leaves[0].room(), slot.end - row);
      for (size_t i = 0; i < out.size(); ++i) out[i] = slot.leaves[i].Next();
      rows.Evaluate(row, count, out.data(), LeafFactor::kStride, &slot.scratch);
      change({k, count, out.data(), LeafFactor::kStride});
      for (LeafFactor& leaf : slot.leaves) leaf.Commit(count);
      row += count;
    }
  };
  work_.Run(prepare, reduce, put);
}

// Batches are evaluated by several threads ahead of the one that `sink` is at,
// one slot each; OrderedWork calls `sink` in the order of rows.
void ForEachBatchOnThreads(const IdentificationRows& rows,
                           const MotionFunctions& functions,
                           const std::function<void(RowBatch*)>& sink) {
  constexpr long kBatch = 32;
  struct Slot {
    RowBatch batch;
    RowScratch scratch;
  };
  const OrderedWork work;
  std::vector<Slot> slots(work.num_slots());
  long next = 0;
  const auto prepare = [&](int k) {
    if (next == rows.size()) return false;
    slots[k].batch.begin = next;
    slots[k].batch.count = std::min(kBatch, rows.size() - next);
    next += slots[k].batch.count;
    return true;
  };
  work.Run(
      prepare,
      [&](int k) {
        slots[k].batch.Evaluate(rows, functions, &slots[k].scratch);
      },
      [&](int k) { sink(&slots[k].batch); });
}

void ForEachRowOnThreads(const IdentificationRows& rows,
                         const MotionFunctions& functions,
                         const RowSink& sink) {
  IdentificationRow row;
  ForEachBatchOnThreads(rows, functions, [&](const RowBatch* batch) {
    batch->ForEachRow(rows, functions, &row, sink);
  });
}

}  // namespace armcal
