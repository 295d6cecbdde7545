// How ModelParameters names its entries.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/dynamics/model_parameters.h"

namespace armcal {
namespace {

const char* MomentSymbol(Moment moment) {
  static const char* const kNames[] = {"m",   "hx",  "hy",  "hz", "(Ixx-Iyy)/2",
                                       "Ixy", "Ixz", "Iyz", "Izz"};
  return kNames[static_cast<int>(moment)];
}

}  // namespace

std::string ModelParameters::FullName(int c) const {
  const int m = static_cast<int>(moments_.size());
  if (c >= m) {
    const JointTermColumn& t = terms_[c - m];
    return std::string(JointTermName(t.term)) + "[" +
           std::to_string(t.joint + 1) + "]";
  }
  const MomentColumn& column = moments_[c];
  const std::string symbol = std::string(MomentSymbol(column.moment)) + "[" +
                             std::to_string(column.block + 1) + "]";
  return column.length < 0 ? symbol
                           : unknown_[column.length].name + "*" + symbol;
}

std::string ModelParameters::FullUnit(int c) const {
  const int m = static_cast<int>(moments_.size());
  if (c >= m) {
    const JointTermColumn& t = terms_[c - m];
    return JointTermUnit(t.term, chain_.joints[t.joint].type);
  }
  static const char* const kPowers[] = {"kg", "kg m", "kg m^2"};
  const Moment moment = moments_[c].moment;
  int power = moment == Moment::kM ? 0 : moment <= Moment::kHz ? 1 : 2;
  if (moments_[c].length >= 0) ++power;
  return kPowers[power];
}

// Says what joint term `j` (a full column) is part of, if it was merged.
void ModelParameters::NameMerged(int j) {
  if (std::find(kept_.begin(), kept_.end(), j) != kept_.end()) return;
  std::string hosts;
  int count = 0;
  for (size_t k = 0; k < kept_.size(); ++k) {
    if (regrouping_(k, j) == 0) continue;
    hosts += (count++ == 0 ? "" : " and ") + FullName(kept_[k]);
  }
  merged_.push_back(
      FullName(j) + " cannot be told from " + hosts +
      (count == 1 ? ": they are one parameter" : ": it is part of them"));
}

// A name is the sum that the parameter stands for, "Izz[1] + armature[1]", read
// from a row of the regrouping.
void ModelParameters::NameParameters() {
  const int m = static_cast<int>(moments_.size());
  for (size_t k = 0; k < kept_.size(); ++k) {
    const int c = kept_[k];
    ModelParameter p;
    p.name = FullName(c);
    p.unit = FullUnit(c);
    p.block = BlockOfFull(c);
    p.is_joint_term = c >= m;
    if (p.is_joint_term) {
      p.term = terms_[c - m].term;
      p.transition = terms_[c - m].transition;
    }
    for (int j = 0; j < NumFull(); ++j) {
      const double x = regrouping_(k, j);
      if (j == c || x == 0) continue;
      char factor[32] = "";
      if (std::abs(std::abs(x) - 1) > 1e-9) {
        std::snprintf(factor, sizeof(factor), "%.4g*", std::abs(x));
      }
      p.name += (x < 0 ? " - " : " + ") + std::string(factor) + FullName(j);
    }
    parameters_.push_back(p);
  }
  for (int j = m; j < NumFull(); ++j) NameMerged(j);
  row_columns_.resize(num_joints());
  for (int k = 0; k < size(); ++k) {
    const ModelParameter& p = parameters_[k];
    for (int i = p.block; i >= 0; i = ParentOf(chain_.parents, i)) {
      row_columns_[i].push_back(k);
      if (p.is_joint_term) break;
    }
  }
}

}  // namespace armcal
