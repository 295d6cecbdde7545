#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/block_triangular_factor.h"
#include "model/model_parameters.h"

namespace armcal {

// How large each parameter's column would be in each joint's equations under a
// rich motion, rms in N m (N) per unit of the parameter: n x m. Columns of a
// log are judged against these, never against their own norm, which would make
// a column that is not excited look excited.
//   speed  rms joint speed of the motion, rad/s (a fifth of it in m/s)
//   hz     its frequency
Eigen::MatrixXd ReferenceColumns(const ModelParameters& parameters,
                                 double speed, double hz);

// A combination of parameters that a log cannot see.
struct UnidentifiableDirection {
  int block = -1;     // of the block rank test; -1: of the whole problem
  Eigen::VectorXd x;  // m entries, the largest 1 in size
  std::string text;   // "1.00 Izz[3] - 0.52 hx[4]"
};

// The rank condition (2.30), block by block, which the recursion (2.28) needs,
// and for all equations at once, which suffices for (2.25): MATH.md A.1.
// A direction counts when it is excited at all (1e-8 of the best seen one) and
// its standard deviation, as torque in the rich motion of ReferenceColumns, is
// below the joint's torque in the log.
struct Identifiability {
  std::vector<int> block_rank;  // numerical rank of U_ii
  std::vector<int> block_size;
  int batch_rank = 0;
  int total = 0;
  std::vector<UnidentifiableDirection> block_directions;
  std::vector<UnidentifiableDirection> directions;  // of all equations

  bool blocks_full() const { return block_rank == block_size; }
};

// Equations of all joints weighted by 1 / noise: R x = z in the least-squares
// sense, with the scale that its directions are judged in.
struct WeightedSystem {
  Eigen::MatrixXd R;      // m x m upper triangular
  Eigen::VectorXd z;      // m
  Eigen::VectorXd scale;  // size of a column relative to the joint's torque

  // Singular directions in scaled parameters y = scale * x.
  struct Directions {
    Eigen::MatrixXd V;  // m x m
    Eigen::VectorXd s;
    int rank;
    Eigen::VectorXd Uz;  // U' z
  };
  Directions Decompose() const;
};

// `noise`: standard deviation of each joint's equations; 0 leaves the joint
// out. `reference`: ReferenceColumns times the row's unit (1, or the interval's
// length for the integral model).
WeightedSystem MakeWeightedSystem(const BlockTriangularFactor& factor,
                                  const Eigen::VectorXd& noise,
                                  const Eigen::MatrixXd& reference);

Identifiability AnalyzeIdentifiability(const BlockTriangularFactor& factor,
                                       const ModelParameters& parameters,
                                       const Eigen::VectorXd& noise,
                                       const Eigen::MatrixXd& reference);

}  // namespace armcal
