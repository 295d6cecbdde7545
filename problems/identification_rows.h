#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "model/model_parameters.h"
#include "model/time_base.h"
#include "model/trajectory.h"

namespace armcal {

// Which identification model turns motion into linear equations U X = Y.
enum class Identification {
  kWeak,          // test functions over sliding windows: weak_rows.h
  kDifferential,  // (2.19): differential_rows.h
  kIntegral       // (2.27): integral_rows.h
};
enum class Quadrature { kTrapezoid, kSimpson };

struct RowOptions {
  Identification identification = Identification::kWeak;
  double window_s = 0.5;  // weak: length of the test functions
  int hops = 4;           // weak: windows start every window_s / hops
  // Integral: the intervals (t1, t2) in s since the log's first row; empty:
  // intervals of interval_s side by side.
  std::vector<TimeRange> intervals;
  double interval_s = 0.5;
  Quadrature quadrature = Quadrature::kTrapezoid;
  double bandwidth_hz = 0;  // differential: low pass of U and tau, 0: none
};

// One equation per joint: row i of U (n x parameters) and Y (n), N m (N), or
// N m s (N s) for the integral model.
struct IdentificationRow {
  double time = 0;  // s, its middle
  Eigen::MatrixXd U;
  Eigen::VectorXd Y;
};
using RowSink = std::function<void(const IdentificationRow&)>;

// How far rows reach beyond the sample they are assigned to, s.
double RowReach(const RowOptions& options);

// Columns P and D of the joints' equations tau = (d/dt P - D) x along a log.
// Use a new one for each pass over a log, and Enter() each trajectory in turn:
// the states of Coulomb friction are followed from one to the next.
class MotionFunctions {
 public:
  virtual ~MotionFunctions() = default;
  virtual int size() const = 0;  // columns
  virtual void Enter(const Trajectory& trajectory) = 0;
  // P and D (n x size()) at a sample of the trajectory entered last.
  virtual void Momentum(int sample, Eigen::MatrixXd* P, Eigen::MatrixXd* D) = 0;
  // With Coulomb friction in the model, a sample at which the whole arm stands
  // still says nothing: its friction can have any value.
  virtual bool Useless(int sample) const = 0;
};

// Those of the model parameters.
class MotionRegressor : public MotionFunctions {
 public:
  explicit MotionRegressor(const ModelParameters& parameters);

  const ModelParameters& parameters() const { return parameters_; }
  int size() const override { return parameters_.size(); }
  void Enter(const Trajectory& trajectory) override;
  void Momentum(int sample, Eigen::MatrixXd* P, Eigen::MatrixXd* D) override;
  bool Useless(int sample) const override;
  // U of (2.20) at a sample.
  void Differential(int sample, Eigen::MatrixXd* U);

 private:
  ModelParameters parameters_;
  Regressor regressor_;
  CoulombStates coulomb_;
  const Trajectory* trajectory_ = nullptr;
  Eigen::MatrixXd states_;
};

// Calls `sink` for every row of the trajectory's core, in order of time. Rows
// that reach into a useless sample are left out.
void ForEachRow(const Trajectory& trajectory, const RowOptions& options,
                MotionRegressor* regressor, const RowSink& sink);

}  // namespace armcal
