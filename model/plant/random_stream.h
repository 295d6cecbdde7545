#pragma once

#include <cstdint>
#include <random>

namespace armcal {

// What random numbers of a simulation are for. Each purpose, log and robot has
// a stream of its own, so that switching one thing on leaves the others as they
// were, and nothing that a log shows tells of what it hides.
enum class RandomPurpose {
  kCase,
  kRobot,
  kMotion,
  kEncoder,
  kTorque,
  kColoured,
  kJitter,
  kLoss,
  kMisfit,
  kDrift
};

// `seed`: the robot; `run`: which of its logs.
inline std::mt19937_64 RandomStream(uint64_t seed, uint64_t run,
                                    RandomPurpose purpose) {
  std::seed_seq sequence{
      static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32),
      static_cast<uint32_t>(run), static_cast<uint32_t>(run >> 32),
      static_cast<uint32_t>(purpose)};
  return std::mt19937_64(sequence);
}

}  // namespace armcal
