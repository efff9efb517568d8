#pragma once

namespace swept {

/// A part of the step. Seconds.
struct StepPart {
    double begin = 0;  ///< since the start of the step
    double length = 0;
    double dt = 0;     ///< of the whole step
    int subSteps = 1;  ///< of the solver
};

}  // namespace swept
