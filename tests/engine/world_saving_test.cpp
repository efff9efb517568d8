#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <swept/engine/image/checksum.h>

#include "world_digest.h"
#include "world_support.h"

/// What `World::load` refuses, and what it keeps. (That a loaded world goes on as the saved one: world_saving_scenes.)

namespace swept::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A plank on a hinge with a crate on it, a platform and a sensor; small, so that all of its bytes can be tried.
struct Seesaw {
    World world = makeWorld(WorldSettings{.gravity = vec(0, -kGravity)});
    KnownIds known;

    Seesaw() {
        const BodyId ground = addStatic(world, box(5, 1));
        BodyDef def = dynamicAt({0, 1.6});
        def.userData = 0xFEDCBA9876543210;
        known.bodies = {ground, addBody(world, def, box(2, 0.1)), addBody(world, dynamicAt({1, 2.3}), box(0.5, 0.5))};
        RevoluteJointDef hinge{.base = {.bodyA = ground, .bodyB = known.bodies[1]}, .anchor = {0, 1.6}};
        hinge.base.userData = 77;
        hinge.limits = AngleLimits{real(-0.3), real(0.3)};
        known.joints.push_back(must(world.createJoint(hinge)));
        ShapeDef sensor;
        sensor.sensor = true;
        sensor.userData = 5;
        known.shapes.push_back(must(world.addShape(ground, must(makeBox(vec(3, 1), vec(0, 2))), sensor)));
        const Vec2 platform[] = {vec(4, 3), vec(2, 3)};
        known.shapes.push_back(must(world.addChain(ground, platform, false)));
        run(world, 20);
    }
};

/// @return the number of the bytes that were accepted
template <class Change>
std::size_t countAccepted(const Bytes& bytes, const Change& change) {
    World world = Seesaw().world;
    must(world.applyImpulse(Seesaw().known.bodies[2], vec(1, 0)));
    run(world, 3);
    const Bytes before = world.save();
    std::size_t accepted = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const Bytes wrong = change(bytes, i);
        const Status status = world.load(wrong);
        accepted += status.ok() ? 1 : 0;
        EXPECT_EQ(status.code, StatusCode::damaged) << "byte " << i;
        EXPECT_STREQ(status.field, "bytes");
    }
    EXPECT_EQ(world.save(), before);
    return accepted;
}

TEST(WorldSaving, RefusesWhatIsCutOff) {
    const Bytes bytes = Seesaw().world.save();
    EXPECT_LT(bytes.size(), 20000u);
    EXPECT_EQ(countAccepted(bytes,
                            [](const Bytes& all, std::size_t length) {
                                return Bytes(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(length));
                            }),
              0u);
    Bytes longer = bytes;
    longer.push_back(0);
    World world;
    EXPECT_EQ(world.load(longer).code, StatusCode::damaged);
}

TEST(WorldSaving, RefusesWhatIsChanged) {
    const Bytes bytes = Seesaw().world.save();
    for (const unsigned flip : {1U, 128U, 255U}) {
        EXPECT_EQ(countAccepted(bytes,
                                [flip](const Bytes& all, std::size_t place) {
                                    Bytes wrong = all;
                                    wrong[place] = static_cast<std::uint8_t>(wrong[place] ^ flip);
                                    return wrong;
                                }),
                  0u);
    }
}

constexpr std::size_t kWordBytes = sizeof(std::uint64_t);
constexpr std::size_t kHeaderWords = 5;

/// With another number in the header (engine/image/world_image.h), and the checksum that belongs to it.
Bytes withHeader(Bytes bytes, std::size_t word, std::uint64_t number) {
    const auto put = [&bytes](std::size_t place, std::uint64_t value) {
        for (std::size_t i = 0; i < kWordBytes; ++i) {
            bytes[place * kWordBytes + i] = static_cast<std::uint8_t>(value >> (8 * i));
        }
    };
    put(word, number);
    const std::span<const std::uint8_t> all = bytes;
    put(kHeaderWords - 1,
        checksumOf(all.subspan(kHeaderWords * kWordBytes)) ^ checksumOf(all.first((kHeaderWords - 1) * kWordBytes)));
    return bytes;
}

TEST(WorldSaving, RefusesWhatOtherBuildsSaved) {
    Seesaw seesaw;
    const Bytes bytes = seesaw.world.save();
    const auto refusalOfWord = [&](std::size_t word, std::uint64_t number) {
        const Status status = seesaw.world.load(withHeader(bytes, word, number));
        EXPECT_EQ(status.code, StatusCode::otherBuild) << word;
        return std::string(status.field);
    };
    EXPECT_EQ(refusalOfWord(0, 5), "version");
    EXPECT_EQ(refusalOfWord(2, kIsDouble ? 4 : 8), "precision");
    EXPECT_EQ(refusalOfWord(3, 5), "layout");
    EXPECT_EQ(seesaw.world.save(), bytes);
    must(seesaw.world.load(withHeader(bytes, 2, sizeof(Real))));
}

/// Whoever makes bytes that look whole can make a world that is none, but what reads them stays within them.
TEST(WorldSaving, ReadsNothingBeyondWhatIsThere) {
    const Bytes bytes = Seesaw().world.save();
    std::size_t refused = 0;
    for (std::size_t i = kHeaderWords * kWordBytes; i < bytes.size(); ++i) {
        Bytes wrong = bytes;
        wrong[i] = 0xFF;
        World world;
        if (!world.load(withHeader(wrong, 1, wrong.size())).ok()) { ++refused; }
    }
    EXPECT_GT(refused, 500u);  // lengths, kinds and truth values
}

TEST(WorldSaving, KeepsUserDataAndIds) {
    const Seesaw seesaw;
    World world;
    must(world.load(seesaw.world.save()));
    EXPECT_EQ(world.userData(seesaw.known.bodies[1]), 0xFEDCBA9876543210u);
    EXPECT_EQ(world.userData(seesaw.known.joints[0]), 77u);
    EXPECT_EQ(world.userData(seesaw.known.shapes[0]), 5u);
    EXPECT_EQ(world.contactEvents().size(), seesaw.world.contactEvents().size());
    EXPECT_EQ(digestOf(world, seesaw.known), digestOf(seesaw.world, seesaw.known));
}

/// Forbids all that the last body touches.
struct NoCrate final : ContactFilter {
    BodyId crate{};
    bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept override {
        return a.body != crate && b.body != crate;
    }
};

TEST(WorldSaving, KeepsTheFilterOfWhoLoads) {
    Seesaw seesaw;
    NoCrate filter;
    filter.crate = seesaw.known.bodies[2];
    World world;
    world.setContactFilter(&filter);
    must(world.load(seesaw.world.save()));
    World original = seesaw.world;
    run(original, 5);
    run(world, 5);
    EXPECT_EQ(digestOf(world, seesaw.known), digestOf(original, seesaw.known)) << "contacts that there are go on";
    world.setContactFilter(&filter);
    run(world, 120);
    EXPECT_LT(world.position(filter.crate).y, 0) << "it fell through everything";
    must(world.load(seesaw.world.save()));
    must(world.setPose(filter.crate, {1, 2.3}, 0));
    run(world, 120);
    EXPECT_LT(world.position(filter.crate).y, 0) << "the filter was lost";
}

TEST(WorldSaving, OfOneThatWasMovedFrom) {
    const Seesaw seesaw;
    World world;
    const World taken = std::move(world);
    must(world.load(seesaw.world.save()));
    EXPECT_EQ(world.stateHash(), seesaw.world.stateHash());
    run(world, 3);
}

TEST(WorldSaving, OfAnEmptyWorld) {
    const World empty;
    World world = Seesaw().world;
    must(world.load(empty.save()));
    EXPECT_EQ(world.bodyCount(), 0u);
    EXPECT_EQ(world.save(), empty.save());
    must(world.step(kStep));
}

}  // namespace
}  // namespace swept::test
