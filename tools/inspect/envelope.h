#pragma once

/// The measured envelope: dimensionless numbers within which the accurate profile keeps its promises at 16 sub-steps.
/// Every number names what was measured and with which command (tools/README.md, "The envelope").

namespace swept::envelope {

/// Heaviest against lightest body of a contact. A box of this many times the mass of the box it stands on sinks in by less
/// than 1 % of the lower one's height; ten times more does not stand.
inline constexpr double kContactMassRatio = 1000;
/// Heaviest against lightest of the bodies that hang on each other by joints: 20 links stretch by less than 1 %.
inline constexpr double kJointMassRatio = 100;
/// Steps in the time √(size/|g|) that a body takes to fall about half its own size. Below it stacks do not stand.
inline constexpr double kStepsPerNaturalTime = 1.5;
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
