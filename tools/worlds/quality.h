#pragma once

namespace swept::worlds {

/// How good a run is, from the poses of its bodies alone: one geometry in double precision for all engines.
struct Quality {
    double deepest = 0;     ///< overlap of two shapes that may collide, metres; the largest of all samples
    double mean = 0;        ///< of all overlaps of all samples, metres
    double jointError = 0;  ///< largest gap of a joint: of hinges, welds, rods; off an axis; of a rope too long; metres
    double energy = 0;      ///< at the last sample, joules: kinetic, and potential (0 at y = 0)
};

}  // namespace swept::worlds
