#pragma once

// A line per effect of geometry, in the order of help and docs:
// X(function), which is the one of its file.
#define ARMCAL_POSE_EFFECTS(X) \
  X(JointCoupling)             \
  X(GearRatio)                 \
  X(EccentricEncoder)          \
  X(SecondHarmonic)            \
  X(MotorHarmonic)             \
  X(JointSag)                  \
  X(ArmSag)                    \
  X(BaseSag)                   \
  X(ToolSag)                   \
  X(LoadGap)                   \
  X(InstrumentScale)           \
  X(JointStep)                 \
  X(JointDrift)                \
  X(ToolStep)                  \
  X(ToolWindow)                \
  X(ToolDrift)                 \
  X(FrameStep)                 \
  X(FrameWindow)               \
  X(FrameDrift)                \
  X(LengthStep)                \
  X(LengthWindow)              \
  X(LengthDrift)               \
  X(ThermalGrowth)
