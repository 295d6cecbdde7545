#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/candidates/coordinates.h"
#include "calib/diagnose/data/data.h"

namespace armcal {

// Effects of which a solver varies the parameters that it may
// (ListCoordinates), and their torques along the logs. Keeps all references.
class VariedEffects {
 public:
  // Springs that are followed together: doubles in the widest register.
  static constexpr size_t kLanes = 8;

  // Parameters of effect `only`, or (-1) of all.
  VariedEffects(const GapBaseline& baseline, const MotionScale& scale,
                std::vector<GapCandidate> effects, int only,
                const GapData& data);

  const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  int size() const { return static_cast<int>(coordinates_.size()); }
  // What the effects are at these coordinates.
  std::vector<GapCandidate> At(const Eigen::VectorXd& u) const;
  // Where a solver may start, as the effects are first. What rings has a
  // minimum wherever its oscillation is in phase with the residual for a while,
  // and only one where it stays so; a solver ends in the one that it starts in.
  // The others are a grid of each linear size, from half to twice of it, by the
  // low end of each shape that is refined; one that was refined already starts
  // where it is. An effect of a single size, such as a limit, starts at that
  // size from every combination of its shapes.
  std::vector<Eigen::VectorXd> Starts() const;
  // At several points, per joint thinned samples. As many at a time as springs
  // have lanes, on all threads.
  std::vector<JointRows> Torques(
      const std::vector<Eigen::VectorXd>& points) const;

 private:
  const EffectParameter& ParameterOf(const Coordinate& c) const;
  std::vector<double> GridOf(const Coordinate& c) const;
  std::vector<const Coordinate*> YetToBeRefined(int effect) const;
  void AddShapes(int effect, std::vector<Eigen::VectorXd>* points) const;
  void AddAround(const Coordinate& size, const Coordinate& shape,
                 std::vector<Eigen::VectorXd>* points) const;

  const GapBaseline& baseline_;
  const MotionScale& scale_;
  std::vector<GapCandidate> effects_;
  std::vector<Coordinate> coordinates_;
  const GapData& data_;
  mutable tbb::enumerable_thread_specific<std::vector<RecordedTorque>> torques_;
};

}  // namespace armcal
