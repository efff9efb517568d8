#pragma once

#include <memory>
#include <vector>

#include <swept/samples/scene_description.h>

#include "peer_world.h"

namespace swept {

/// A scene in Box2D 2.4.1.
class Box2dWorld final : public PeerWorld {
public:
    /// @param scene  accepted by `validateScene`; outlives the world.
    Box2dWorld(const SceneDescription& scene, const Box2dIterations& iterations);
    ~Box2dWorld() override;

    void remove(std::span<const std::uint32_t> bodies) override;
    void add(std::span<const std::uint32_t> bodies) override;
    void setVelocity(std::uint32_t body, DVec2 velocity) override;

private:
    void advance() override;
    void afterStep() override;
    bool isThere(std::size_t body) const override;
    void readBody(std::size_t body, PeerSample& sample) const override;
    void readRest(PeerSample& sample) const override;

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace swept
