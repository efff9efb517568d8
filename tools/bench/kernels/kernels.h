#pragma once

/// Benchmarks of Google's library for the kernels beside `distance`: each call registers some.

namespace swept::bench {

/// penetration, collide, rayCast, convexHull: in both precisions.
void registerShapeKernelsF32();
void registerShapeKernelsF64();
/// Passes over contacts, and what the machine computes and reads at best: in both precisions.
void registerSolverKernelsF32();
void registerSolverKernelsF64();
/// Bodies that nothing holds: in both precisions, and in Chipmunk where that is installed.
void registerFlightKernelsF32();
void registerFlightKernelsF64();
void registerFlightChipmunk();
/// What they have in common: distances, m; disks in a row; seconds of a step. No gravity: within the million steps of a
/// measurement they would become fast, and be swept.
inline constexpr double kFlightGap = 3;
inline constexpr int kFlightWide = 100;
inline constexpr double kFlightStep = 1.0 / 60;
/// What is made and destroyed between steps: in both precisions, and in Box2D 2.4.1.
void registerEditKernelsF32();
void registerEditKernelsF64();
void registerEditBox2d();
/// What they have in common: boxes in a row of the pile; bodies destroyed, and made again, between two steps.
inline constexpr int kEditWide = 100;
inline constexpr int kEdited = 50;
/// Steps of the pile: only what is done between them is measured.
inline constexpr int kEditRounds = 60;
/// Which of the pile, or of the tiles of a level, the next one is: all over the place.
inline int editedOf(int next, int count) { return static_cast<int>(next * 7919LL % count); }
/// Every method, on the generic family.
void registerToiKernels();

}  // namespace swept::bench
