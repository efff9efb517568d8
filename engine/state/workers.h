#pragma once

#include "../../shapes/real.h"
#include "../crew/crew.h"
#include "../task_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Who runs the loops of a world. A copy has a crew of its own, and works for the same user.
struct Workers {
    SerialTaskSystem serialTasks;
    TaskSystem* userTasks = &serialTasks;  ///< what the user gave; stages use `loops`
    Crew crew;
    TaskSystem* loops = &serialTasks;  ///< where the parallel loops of the present step run

    Workers() = default;
    Workers(const Workers& other) { *this = other; }
    Workers& operator=(const Workers& other) {
        if (this == &other) { return *this; }
        userTasks = other.userTasks == &other.serialTasks ? &serialTasks : other.userTasks;
        return *this;
    }
    ~Workers() = default;
};

}  // namespace swept::inline SWEPT_PRECISION
