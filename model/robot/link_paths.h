#pragma once

#include <vector>

namespace armcal {

// How the links of a robot hang together: entry i is the link on which joint i
// sits, -1 for the base. Always an earlier one; what a joint moves follows its
// link without a gap (depth first), so that it is links i to EndOfBranch - 1.
// Empty: a chain, where it is the link before.
using LinkParents = std::vector<int>;

inline int ParentOf(const LinkParents& parents, int i) {
  return parents.empty() ? i - 1 : parents[i];
}
// Whether joint j moves link i.
bool Moves(const LinkParents& parents, int j, int i);
// One past the last of the links that joint i moves, of n.
int EndOfBranch(const LinkParents& parents, int i, int n);
// Links that carry no other, of n.
std::vector<int> TipsOf(const LinkParents& parents, int n);

// A way from the base to a tip. Forces and momenta are sums over the links, so
// that a robot that branches moves as the sum of the chains along its paths,
// each link with its body in one of them and without in the others:
//   tau_j = sum over paths with joint j of tau_j(chain of the path).
struct LinkPath {
  std::vector<int> links;  // base to tip
  int first_own = 0;       // place in `links` of the first that is on no path
                           // before
};
std::vector<LinkPath> PathsOf(const LinkParents& parents, int n);

}  // namespace armcal
