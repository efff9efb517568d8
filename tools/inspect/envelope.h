#pragma once

/// The measured envelope: dimensionless numbers within which the accurate profile keeps its promises at 16 sub-steps.
/// Measured with `swept bench accuracy`, whose scenes are named here, or read off the maps of `swept envelope`.

namespace swept::envelope {

/// A body on top of a lighter one, where they are not a tower: measured before towers were solved directly, when the
/// lower box gave way by less than 1 % of its height up to here, and proportionally more beyond. Towers: map "stack",
/// where all of 10 … 10⁶ is inside; what leans on several bodies has no map yet.
inline constexpr double kContactMassRatio = 200;
/// Heaviest against lightest of the bodies that hang on each other by joints. Map "chain": in both precisions every
/// chain of 1 … 64 links that is let go level swings 1.7·10⁴ : 1 with joints open by less than 1 % of a link; beyond, a
/// few are torn apart. Less than that, as the map has eight numbers of links only.
inline constexpr double kJointMassRatio = 5000;
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
/// Part of the smaller extent that two bodies may overlap at the start without being thrown apart visibly.
inline constexpr double kStartOverlap = 1.0 / 1024;

}  // namespace swept::envelope
