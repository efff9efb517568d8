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
/// Every method, on the generic family.
void registerToiKernels();

}  // namespace swept::bench
