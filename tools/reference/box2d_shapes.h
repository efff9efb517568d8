#pragma once

#include <box2d/box2d.h>
#include <deque>

#include <swept/samples/scene_description.h>
#include <swept/samples/scene_surfaces.h>

namespace swept {

/// What the adapter remembers of a fixture, reached through its user data.
struct Box2dFixtureNote {
    const ShapeDescription* shape = nullptr;
    bool isSensor = false;
    float radius = 0;  ///< the true radius of the geometry, where Box2D works with a thicker skin; metres
    FullSurface surface{};
};

inline b2Vec2 toBox2d(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }
inline DVec2 fromBox2d(b2Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

/// Adds the fixtures of one shape to a body: of a chain with surfaces of its segments, one for each. Fixtures have
/// density 0: Box2D leaves radii out of the mass, so the adapter sets the exact mass of the whole body itself.
/// @param notes  gets one element for each fixture; a deque, as fixtures hold addresses of its elements.
void addFixtures(b2Body& body, const ShapeDescription& shape, std::deque<Box2dFixtureNote>& notes);

/// Surface speeds, which Box2D wants told anew before each solve, and what pairs mix by rules of their own.
class Box2dSurfaces : public b2ContactListener {
public:
    void PreSolve(b2Contact* contact, const b2Manifold* before) override;
};

/// The filter of the scene format in all its 32 bits, where Box2D itself has 16.
class Box2dFilter : public b2ContactFilter {
public:
    bool ShouldCollide(b2Fixture* fixtureA, b2Fixture* fixtureB) override;
};

}  // namespace swept
