#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/numerics/block_triangular_factor.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// What directions of a log are judged against, never their own norms, which
// would make a column that is not excited look excited.
struct ReferenceScale {
  // rms of each parameter's column in each joint's equations under a rich
  // motion, per unit of the parameter: n x m.
  Eigen::MatrixXd columns;
  // What is a large torque of each joint: the larger of its rms in the log and
  // of the rms terms that the nominal parameters make of `columns` (an arm that
  // swings freely carries hardly any torque).
  Eigen::VectorXd torque;
};

// A random motion with rms joint speed `speed` (rad/s; a fifth of it in m/s) at
// frequency `hz`; `unit` is what rows are integrated over (1, or the interval's
// length in s); `recorded` the rms right-hand side per joint; `nominal` the
// parameters of the robot file, zero where it has none.
ReferenceScale MakeReferenceScale(const ModelParameters& parameters,
                                  double speed, double hz, double unit,
                                  const Eigen::VectorXd& recorded,
                                  const Eigen::VectorXd& nominal);

// A combination of parameters that a log cannot see.
struct UnidentifiableDirection {
  int block = -1;     // of the block rank test; -1: of the whole problem
  Eigen::VectorXd x;  // m entries, the largest 1 in size
  std::string text;   // "viscous[4]", "1.00 Izz[3] - 0.52 hx[4]"
};

// A motion of some joints together while the others rest.
struct AdvisedMotion {
  std::vector<int> joints;  // from 0
  int rank;                 // directions that show after it and those before it
};

// The rank condition (2.30), block by block, which the recursion (2.28) needs,
// and for all equations at once, which suffices for (2.25): a SCARA with two
// intervals has rank 2 of 3 in block 2 and 6 of 6 altogether.
// A direction counts when it is excited at all (1e-8 of the best seen one) and
// its standard deviation, as torque in the reference motion, is below what is a
// large torque there.
struct Identifiability {
  std::vector<int> block_rank;  // numerical rank of U_ii
  std::vector<int> block_size;
  int batch_rank = 0;
  int total = 0;
  std::vector<UnidentifiableDirection> block_directions;
  std::vector<UnidentifiableDirection> directions;  // of all equations
  std::vector<AdvisedMotion> advice;  // AdviseMotions, where asked for

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
  // The inverse of R in scaled parameters, where every direction counts beyond
  // doubt; else nothing. Much cheaper than directions.
  std::optional<Eigen::MatrixXd> Inverse() const;
};

// `noise`: standard deviation of each joint's equations; 0 leaves the joint
// out.
WeightedSystem MakeWeightedSystem(const BlockTriangularFactor& factor,
                                  const Eigen::VectorXd& noise,
                                  const ReferenceScale& reference);

Identifiability AnalyzeIdentifiability(const BlockTriangularFactor& factor,
                                       const ModelParameters& parameters,
                                       const Eigen::VectorXd& noise,
                                       const ReferenceScale& reference);

}  // namespace armcal
