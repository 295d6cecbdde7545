#pragma once

#include <vector>

#include "calib/inspect/reading_change.h"
#include "calib/inspect/torque_scale.h"

namespace armcal {

// A reading that differs from another by one change.
struct Candidate {
  LogReading reading;
  ReadingChange change;
};

// Two joints' positions, torques or both exchanged, and each joint's position,
// torque or both turned round; of joints that are `asked`. And all torques, or
// all positions, turned round at once: no sum of what single joints' signs
// explain tells that, since a fit whose other torques are still wrong takes
// their wrong inertias for right. Those that move alike follow each other.
std::vector<Candidate> WiringCandidates(const LogReading& from,
                                        const std::vector<bool>& asked);

// Positions in the unit that `kind` (kDegrees, kMillimetres) names where they
// are not, else in rad or m.
Candidate InOtherUnit(const LogReading& from, ReadingChange::Kind kind);
// The same of one of the joints that are asked and are of this kind each: a
// column that came from elsewhere than the others.
std::vector<Candidate> OneInOtherUnit(const LogReading& from,
                                      ReadingChange::Kind kind,
                                      const Robot& robot,
                                      const std::vector<bool>& asked);

// Both of both units, of joints that turn and slide, if there are some.
std::vector<Candidate> UnitCandidates(const LogReading& from,
                                      const Robot& robot,
                                      const std::vector<bool>& asked);

// Torques that are divided by how many times those that the file's links need
// they are, where no inertias near the file's would be (kNotInertia): alone,
// and with each of WiringCandidates, as a sign or an order may show in the
// right unit alone. A sign that is asked of torques a thousand times as large
// is one of an arm that no file describes: the bodies of the fit, which stay
// near the file's, explain next to nothing of them, and another sign or
// direction may explain more than that by chance.
void AddTorqueUnit(const LogReading& from, const TorqueScales& as_logged,
                   const std::vector<bool>& asked,
                   std::vector<Candidate>* candidates);

// TorqueFit's misfit of torques `tau` as the reading has them, as that of those
// that are logged: log p(tau / u) is that of tau plus log u for each of them, u
// being the reading's unit.
double MisfitAsLogged(const TorqueFit& fit, const LogReading& reading,
                      const Eigen::MatrixXd& tau, double* percent = nullptr);

// Gravity of that size, m/s^2, along each axis of the world, and none.
std::vector<Candidate> GravityCandidates(const LogReading& from,
                                         double magnitude);

// The reading with gravity the other way round.
LogReading WithTurnedGravity(LogReading reading);
// All torques turned round together with gravity, which was found while they
// were not: of slow motions both signs together change next to nothing, so the
// direction that was found is one of two until torques have their sign.
void AddTurnedGravity(std::vector<Candidate>* candidates);

}  // namespace armcal
