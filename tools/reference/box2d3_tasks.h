#pragma once

#include <memory>

#include <box2d/types.h>

namespace swept {

/// Threads for a world of Box2D 3: its tasks in an arena of oneTBB, as `TbbTaskSystem` runs our loops. Without oneTBB,
/// and for one thread, the world stays on the calling one.
class Box2d3Tasks {
public:
    /// @param threads  the calling one included, at least 1
    explicit Box2d3Tasks(int threads);
    Box2d3Tasks(const Box2d3Tasks&) = delete;
    Box2d3Tasks& operator=(const Box2d3Tasks&) = delete;
    ~Box2d3Tasks();

    /// A world of this definition uses them; they outlive it.
    void addTo(b2WorldDef& definition) const;

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace swept
