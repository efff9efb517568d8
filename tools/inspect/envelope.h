#pragma once

/// The measured envelope: dimensionless numbers within which the accurate profile keeps its promises at 16 sub-steps.
/// Measured with `swept bench accuracy`, whose scenes are named here.

namespace swept::envelope {

/// A body on top of a lighter one: up to this ratio of masses the lower box gives way by less than 1 % of its height, and
/// proportionally more beyond (heavy-top-1-R100: 0.44 %, heavy-top-1-R1000: 4.4 %; heavy-top-10-R1000 collapses).
inline constexpr double kContactMassRatio = 200;
/// Heaviest against lightest of the bodies that hang on each other by joints: 20 links stretch by about 1 % when they swing,
/// a third of that at rest (chain-swung-R100: 1.2 %, chain-R100: 0.32 %), and proportionally more beyond.
inline constexpr double kJointMassRatio = 100;
/// Steps in the time √(size/|g|) that a body takes to fall half its own size. Ten boxes stand above 3 and topple below
/// (3.3: they stand; 2.7: they do not); three boxes still stand at 1.3.
inline constexpr double kStepsPerNaturalTime = 3;
/// Seconds to fall its own size: beyond these the numbers are probably not metres.
inline constexpr double kShortestFall = 0.01;
inline constexpr double kLongestFall = 2;
/// Smallest distance of two vertices, as a part of the shape's size, that single precision still tells apart well.
inline constexpr double kVertexDistance = 1e-5;
/// Length over width of what moves, and of pieces of ground against what rests on them.
inline constexpr double kAspectRatio = 1000;
/// Sizes a body may be away from its partner in single precision, as a part of 2²⁴, before rounding exceeds the tolerance
/// of the time of impact (a quarter of 1/1024 of the extent).
inline constexpr double kToleranceRatio = 1.0 / 4096;
/// Part of its extent that a body may move in a step without being swept.
inline constexpr double kFastRatio = 0.25;
/// Part of the smaller extent that two bodies may overlap at the start without being thrown apart visibly.
inline constexpr double kStartOverlap = 1.0 / 1024;

}  // namespace swept::envelope
