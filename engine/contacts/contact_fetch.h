#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../state/world_state.h"

/// What the stages of contacts and of boxes fetch from memory before they get there.

namespace swept::inline SWEPT_PRECISION {

/// Near contacts that are fetched from memory ahead of time: first themselves, then what they refer to. (Their probes
/// come in order.)
inline constexpr std::size_t kContactsAhead = 12;
inline constexpr std::size_t kShapesAhead = 4;
/// Bodies whose motion is noted: they are awake in an order that is not that of their slots.
inline constexpr std::size_t kBodiesAhead = 8;

/// Contacts that begin or end, of which there are few in between, and then what is told of their ends.
inline constexpr std::size_t kEventContactsAhead = 8;
inline constexpr std::size_t kEventShapesAhead = 4;

template <class T>
SWEPT_FORCE_INLINE void fetch(const T& thing) {
    const char* const first = reinterpret_cast<const char*>(&thing);
    for (std::size_t i = 0; i < sizeof(T); i += kCacheLine) { prefetch(first + i); }
    if constexpr (alignof(T) < kCacheLine) {
        prefetch(first + (sizeof(T) - 1));  // it begins anywhere in a line
    }
}

/// A contact has the rest of what is asked of it.
SWEPT_FORCE_INLINE void fetchPolygon(const Polygon& polygon, std::size_t vertices) {
    constexpr std::size_t kPerLine = kCacheLine / sizeof(Vec2);
    prefetch(polygon.vertices.data());
    prefetch(polygon.normals.data());
    if constexpr (kPerLine < kMaxPolygonVertices) {
        if (vertices <= kPerLine) { return; }
        prefetch(polygon.vertices.data() + kPerLine);
        prefetch(polygon.normals.data() + kPerLine);
    }
}

/// What is asked of a body that is awake, before any of its contacts is. (Its inputs lie behind its hot state.)
SWEPT_FORCE_INLINE void fetchAhead(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kBodiesAhead) { return; }
    const std::uint32_t slot = coming[kBodiesAhead];
    const Body& body = world.bodies[slot];
    prefetch(&body);
    prefetch(&body.def.type);
    prefetch(&body.def.gravityScale);
    prefetch(&world.motions[slot]);
    fetchToWrite(world.travels[slot]);
    fetchToWrite(world.glances[slot]);
}

/// What is asked of a body, and of the first of its shapes, as its boxes are made anew.
SWEPT_FORCE_INLINE void fetchForBoxes(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kBodiesAhead + kShapesAhead) { return; }
    const std::uint32_t slot = coming[kBodiesAhead + kShapesAhead];
    const Body& body = world.bodies[slot];
    prefetch(&body);
    prefetch(&body.def.type);
    prefetch(&body.shapes);
    prefetch(&world.motions[slot]);
    fetchToWrite(world.travels[slot]);
    prefetch(world.bodies[coming[kBodiesAhead]].shapes.data());
    const Body& next = world.bodies[coming[kShapesAhead]];
    if (next.shapes.empty()) { return; }
    const Shape& shape = world.shapes[next.shapes.front()];
    prefetch(shape.polygon.vertices.data());
    prefetch(&shape.polygon.radius);
    prefetch(&shape.proxy);
}

/// Contacts lie all over memory, since most of those between them are idle: without this each waits for it several
/// times. @param coming  of the same worker: another one may be writing to the probes after them
SWEPT_FORCE_INLINE void fetchAhead(const WorldState& world, std::span<const ContactProbe> probes,
                                   std::span<const Contact> contacts, std::span<const std::uint32_t> coming) {
    if (coming.size() > kContactsAhead) { fetch(contacts[probes[coming[kContactsAhead]].contact]); }
    if (coming.size() > kShapesAhead) {
        const ContactProbe& probe = probes[coming[kShapesAhead]];
        const Contact& contact = contacts[probe.contact];
        fetch(world.motions[contact.bodyA]);
        fetch(world.motions[contact.bodyB]);
        if (probe.wasKept) { return; }
        fetchPolygon(world.shapes[contact.shapeA].polygon, contact.verticesA);
        fetchPolygon(world.shapes[contact.shapeB].polygon, contact.verticesB);
    }
}

/// What is asked of a contact that may begin or end. @param coming  from that on which is next
SWEPT_FORCE_INLINE void fetchForEvents(const WorldState& world, std::span<const ContactLists::Other> coming) {
    if (coming.size() > kEventContactsAhead) {
        const Contact& contact = world.contacts[world.probes[coming[kEventContactsAhead].probe].contact];
        prefetch(&contact);
        fetchToWrite(contact.touching);
    }
    if (coming.size() > kEventShapesAhead) {
        const Contact& contact = world.contacts[world.probes[coming[kEventShapesAhead].probe].contact];
        prefetch(&world.shapes[contact.shapeA].head);
        prefetch(&world.shapes[contact.shapeB].head);
        world.bodies.fetchId(contact.bodyA);
        world.bodies.fetchId(contact.bodyB);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
