#pragma once

#include <memory>

#include <swept/engine/state/world_state.h>
#include <swept/engine/world.h>

/// What no call tells, since it is no business of users. Explicit instantiations may name what is private.

namespace swept::test {
namespace {  // each program has its own: there may be but one explicit instantiation of a name

WorldState& stateOf(const World& world);
template <std::unique_ptr<WorldState> World::*kState>
struct StateOf {
    friend WorldState& stateOf(const World& world) { return *(world.*kState); }
};
template struct StateOf<&World::state_>;

}  // namespace
}  // namespace swept::test
