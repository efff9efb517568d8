#pragma once

/// Benchmarks of Google's library for the kernels beside `distance`: each call registers some.

namespace swept::bench {

/// penetration, collide, rayCast, convexHull: in both precisions.
void registerShapeKernelsF32();
void registerShapeKernelsF64();
/// Passes over contacts, and what the machine computes and reads at best: in both precisions.
void registerSolverKernelsF32();
void registerSolverKernelsF64();
/// Every method, on the generic family.
void registerToiKernels();

}  // namespace swept::bench
