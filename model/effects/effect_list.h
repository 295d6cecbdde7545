#pragma once

// A line per effect, in the order of help and of docs/effects/README.md:
// X(function), which is the one of its file.
#define ARMCAL_EFFECTS(X)       \
  X(ViscousFriction)            \
  X(CoulombFriction)            \
  X(TorqueOffset)               \
  X(AsymmetricFriction)         \
  X(QuadraticFriction)          \
  X(Stribeck)                   \
  X(LoadFriction)               \
  X(PositionFriction)           \
  X(CoupledFriction)            \
  X(Presliding)                 \
  X(Armature)                   \
  X(Elasticity)                 \
  X(Backlash)                   \
  X(Spring)                     \
  X(Cable)                      \
  X(TorqueRipple)               \
  X(TorqueGain)                 \
  X(TorqueGainOfAllJoints)      \
  X(TorqueNonlinearity)         \
  X(TorqueSaturation)           \
  X(TorqueDeadband)             \
  X(TorqueCrosstalk)            \
  X(Delay)                      \
  X(EncoderOffset)              \
  X(LinkLength)                 \
  X(BaseTilt)                   \
  X(Payload)                    \
  X(AddedMass)                  \
  X(LinkInertia)                \
  X(ThermalFriction)            \
  X(ViscousFrictionOfAllJoints) \
  X(TimeDrift)                  \
  X(ExternalContact)            \
  X(Vibration)                  \
  X(TimeBase)
