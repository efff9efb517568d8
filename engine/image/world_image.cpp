#include "world_image.h"

#include <bit>
#include <cassert>

#include "../../solver/body_state.h"
#include "broadphase_image.h"
#include "checksum.h"
#include "decode.h"
#include "encode.h"
#include "world_members.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// To be raised when members of the same kinds change places, or their meaning, which their layout does not tell.
constexpr std::uint64_t kImageVersion = 1;

/// "Swept2D\n", where bytes stand in this order.
constexpr std::uint64_t kImageMagic = 0x0A44327470657753 + ((kImageVersion - 1) << 56U);

struct ImageHeader {
    std::uint64_t magic = kImageMagic;
    std::uint64_t length = 0;
    std::uint64_t precision = sizeof(Real);
    std::uint64_t layout = 0;
    std::uint64_t checksum = 0;
};
constexpr std::size_t kHeaderBytes = kLayout<ImageHeader>.bytes;
constexpr std::size_t kChecksumAt = kHeaderBytes - sizeof(std::uint64_t);

std::uint64_t layoutOfImage() { return std::rotl(kLayout<WorldState>.hash, 32) ^ layoutOfBroadphases(); }

std::uint64_t checksumOfImage(std::span<const std::uint8_t> bytes) {
    return checksumOf(bytes.subspan(kHeaderBytes)) ^ checksumOf(bytes.first(kChecksumAt));
}

}  // namespace

std::vector<std::uint8_t> imageOf(const WorldState& world) {
    const BroadphaseKind kind = world.settings.broadphase;
    std::size_t size = kHeaderBytes + sizeof(kind) + encodedSize(world);
    size += encodedSize(kind, *world.broadphase);
    std::vector<std::uint8_t> bytes(size);
    Encoder content(bytes.data() + kHeaderBytes);
    content.put(kind);
    encode(content, kind, *world.broadphase);
    content.put(world);
    assert(content.at() == bytes.data() + bytes.size());
    ImageHeader header{.length = bytes.size(), .layout = layoutOfImage()};
    Encoder(bytes.data()).put(header);
    header.checksum = checksumOfImage(bytes);
    Encoder(bytes.data()).put(header);
    return bytes;
}

Status checkImage(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kHeaderBytes) { return {StatusCode::damaged, "bytes"}; }
    ImageHeader header;
    Decoder(bytes.first(kHeaderBytes)).take(header);
    const bool isWhole = header.length == bytes.size() && header.checksum == checksumOfImage(bytes);
    if (!isWhole) { return {StatusCode::damaged, "bytes"}; }
    if (header.magic != kImageMagic) { return {StatusCode::otherBuild, "version"}; }
    if (header.precision != sizeof(Real)) { return {StatusCode::otherBuild, "precision"}; }
    if (header.layout != layoutOfImage()) { return {StatusCode::otherBuild, "layout"}; }
    return Status::success();
}

Status readImage(std::span<const std::uint8_t> bytes, WorldState& world) {
    Decoder content(bytes.subspan(kHeaderBytes));
    BroadphaseKind kind{};
    content.take(kind);
    if (static_cast<int>(kind) >= kBroadphaseKindCount) { return {StatusCode::damaged, "bytes"}; }
    world.broadphase = makeBroadphase(kind);
    decode(content, kind, *world.broadphase);
    content.take(world);
    world.solverSlots.assign(world.bodies.slotCount(), kFixedSlot);  // as between all solves
    const bool makesSense = content.isDone() && world.settings.broadphase == kind;
    return makesSense ? Status::success() : Status{StatusCode::damaged, "bytes"};
}

}  // namespace swept::inline SWEPT_PRECISION
