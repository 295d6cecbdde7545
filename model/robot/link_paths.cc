#include "model/robot/link_paths.h"

#include <algorithm>

namespace armcal {

bool Moves(const LinkParents& parents, int j, int i) {
  while (i > j) i = ParentOf(parents, i);
  return i == j;
}

int EndOfBranch(const LinkParents& parents, int i, int n) {
  int end = i + 1;
  while (end < n && ParentOf(parents, end) >= i) ++end;
  return end;
}

std::vector<int> TipsOf(const LinkParents& parents, int n) {
  std::vector<int> tips;
  for (int i = 0; i < n; ++i) {
    if (EndOfBranch(parents, i, n) == i + 1) tips.push_back(i);
  }
  return tips;
}

std::vector<LinkPath> PathsOf(const LinkParents& parents, int n) {
  std::vector<LinkPath> paths;
  std::vector<bool> is_taken(n, false);
  for (const int tip : TipsOf(parents, n)) {
    LinkPath path;
    for (int i = tip; i >= 0; i = ParentOf(parents, i)) path.links.push_back(i);
    std::reverse(path.links.begin(), path.links.end());
    while (is_taken[path.links[path.first_own]]) ++path.first_own;
    for (const int i : path.links) is_taken[i] = true;
    paths.push_back(path);
  }
  return paths;
}

}  // namespace armcal
