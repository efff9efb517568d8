#pragma once

/// The measured envelope: dimensionless numbers within which the engine keeps its promises. Measured with `swept bench
/// accuracy`, whose scenes are named here, read off the maps of `swept envelope`, or as told.

namespace swept::envelope {

/// What is iterated gives way like springs: under a load of R times a body's mass by this times R·|g|·h², h the
/// sub-step. Measured in profile `fast`, 60 Hz: boxes of 1 m that a heavy one is dropped on from 1 cm sink in by 0.7 mm
/// times R (R 10 … 1000; one to three layers, two boxes side by side half of that), chains of 1 … 20 links of 1 m open
/// by 0.3 mm times R where they hang, 0.6 mm where they are let go level.
inline constexpr double kSpringGive = 4;
/// Part of its size that a body may give way by.
inline constexpr double kMostGive = 0.01;
/// Heaviest against lightest of what is solved all at once. Maps "stack" and "chain": towers, and chains of 1 … 64
/// links that are let go level, are inside for all of it, in both precisions.
inline constexpr double kDirectMassRatio = 1e6;
/// What profile `accurate` solves all at once may have no fewer sub-steps.
inline constexpr int kFewestSubSteps = 8;
/// Nor, where its joints close loops, more bodies. (Long thin ones may have 256, which is not looked at here.)
inline constexpr int kMostLoopBodies = 64;
/// Nor, where its contacts do and it moves. (Test Stack.HeavyDroppedOnTwoLightColumnsStands: 10⁵ : 1.)
inline constexpr int kMostPileBodies = 16;
/// Steps in the time √(size/|g|) that a body takes to fall half its own size. Map "stack" is all inside by now, as what
/// rests is solved all at once: this limit is that of stacks that something keeps moving, which iteration carries.
/// Measured when it carried all of them: six boxes with a top of √10 times the mass stood up to g·dt²/size = 1/8, which
/// is 2.8 steps; ten boxes at 3.3.
inline constexpr double kStepsPerNaturalTime = 3;
/// Seconds to fall its own size: beyond these the numbers are probably not metres.
inline constexpr double kShortestFall = 0.01;
inline constexpr double kLongestFall = 2;
/// Smallest distance of two vertices, as a part of the shape's size, that single precision still tells apart well.
inline constexpr double kVertexDistance = 1e-5;
/// Length over width of what moves, and of pieces of ground against what rests on them. Map "bullet": its end.
inline constexpr double kAspectRatio = 1000;
/// Sizes a body may be away from its partner in single precision, as a part of 2²⁴, before rounding exceeds the
/// tolerance of the time of impact (a quarter of 1/1024 of the extent).
inline constexpr double kToleranceRatio = 1.0 / 4096;
/// Part of its extent that a body may move in a step without being swept.
inline constexpr double kFastRatio = 0.25;
/// Fastest push out of an overlap, parts of the smaller extent a step, in each profile.
inline constexpr double kPush = 1.0 / 16;
inline constexpr double kFastPush = 1.0 / 8;
/// Part of the smaller extent that two bodies may overlap at the start without being thrown apart visibly.
inline constexpr double kStartOverlap = 1.0 / 1024;

}  // namespace swept::envelope
