#pragma once

namespace armcal {

// The classical Runge-Kutta method, whose stages are made implicit in a part A
// y of the rates that is fast: a W-method (Hairer, Wanner, Solving Ordinary
// Differential Equations II, IV.7). Stage i of y' = f(y) is
//   k_i = f(y + h sum_j<i a_ij k_j) + h A sum_j<=i c_ij k_j,  a_i,i-1 = node_i.
// The c_ij meet the order conditions for any A up to order 3 (without A the
// step is the classical one, of order 4) and make it A- and L-stable:
// b'(a + c)^-1 1 = 1.
struct WMethod {
  static constexpr int kStages = 4;
  static constexpr double kNode[kStages] = {0, .5, .5, 1};
  static constexpr double kWeight[kStages] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
  static constexpr double kGamma = .25;  // c_ii
  static constexpr double kImplicit[kStages][kStages - 1] = {
      {}, {-3. / 20}, {43. / 320, -47. / 64}, {1. / 32, 29. / 96, -1. / 3}};
};

}  // namespace armcal
