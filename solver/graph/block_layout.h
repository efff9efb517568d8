#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../wide/wide_contacts.h"
#include "constraint_colours.h"

namespace swept::inline SWEPT_PRECISION {

/// Where a joint of a solve stands.
struct BlockPlace {
    std::uint32_t index = 0;  ///< of the block, or among the joints that stand alone
    std::uint8_t lane = 0;
    bool isInBlock = false;
};

/// Which joints of one sort stand together in the blocks of the wide kernels: of each colour those with the same parts;
/// what is left over, or has no kernel, stands alone. Kept for its capacity.
class BlockLayout {
public:
    /// What joints have beside what all of the sort have, as a number; or that they stand alone.
    using Kind = std::uint8_t;
    static constexpr Kind kAlone = 8;

    /// Of one colour.
    struct Colour {
        ColourRange blocks;
        ColourRange rest;
    };

    /// So many joints are noted next, each once.
    void begin(std::size_t joints) {
        counts_ = {};
        jointColours_.resize(joints);
        kinds_.resize(joints);
    }
    void note(std::size_t joint, std::uint8_t colour, Kind kind) {
        jointColours_[joint] = colour;
        kinds_[joint] = kind;
        ++counts_[colour][kind];
    }

    /// Gives each colour its blocks. @param open  called with index, lanes in use, and kind of each
    template <class Open>
    void layOut(std::span<const int> activeColours, const Open& open) {
        blocks_ = 0;
        rest_ = 0;
        for (const int active : activeColours) {
            const auto c = static_cast<std::size_t>(active);
            colours_[c] = {{blocks_, blocks_}, {rest_, rest_}};
            next_[c] = {};
            next_[c][kAlone] = rest_;
            for (Kind kind = 0; kind < kAlone; ++kind) {
                const std::uint32_t count = counts_[c][kind];
                if (count == 0) { continue; }
                ranges_[c][kind] = reserve(count, kind, open);
                rest_ += count % kLanes < kFewestLanes ? count % kLanes : 0;
            }
            rest_ += counts_[c][kAlone];
            colours_[c].blocks.end = blocks_;
            colours_[c].rest.end = rest_;
        }
    }
    /// There are no joints.
    void forgetBlocks() { blocks_ = rest_ = 0; }
    /// In the order of the joints: so they stand in each colour. @pre laid out
    void listPlaces() {
        places_.resize(kinds_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) { places_[i] = placeFor(kinds_[i], jointColours_[i]); }
    }

    /// By joint. @pre listed
    std::span<const BlockPlace> places() const { return places_; }
    std::uint32_t blockCount() const { return blocks_; }
    std::uint32_t restCount() const { return rest_; }
    /// @pre the colour is active, as of what follows
    const Colour& of(int colour) const { return colours_[static_cast<std::size_t>(colour)]; }
    /// Blocks, and joints on their own, of a colour.
    std::size_t countOf(int colour) const {
        const auto& [blocks, rest] = of(colour);
        return (blocks.end - blocks.begin) + (rest.end - rest.begin);
    }

private:
    /// A block with fewer joints costs more than they do one by one.
    static constexpr std::uint32_t kFewestLanes = 2;
    static constexpr auto kLanes = static_cast<std::uint32_t>(kBlockLanes);

    using KindCounts = std::array<std::uint32_t, kAlone + 1>;
    using KindRanges = std::array<ColourRange, kAlone>;

    /// Blocks for joints of one colour and kind, all but the one that may be left over.
    template <class Open>
    ColourRange reserve(std::uint32_t joints, Kind kind, const Open& open) {
        const std::uint32_t begin = blocks_;
        while (joints >= kFewestLanes) {
            const std::uint32_t lanes = std::min(joints, kLanes);
            open(blocks_++, lanes, kind);
            joints -= lanes;
        }
        return {begin, blocks_};
    }
    BlockPlace placeFor(Kind kind, std::size_t colour) {
        KindCounts& next = next_[colour];
        if (kind != kAlone) {
            const std::uint32_t place = next[kind]++;
            const std::uint32_t block = ranges_[colour][kind].begin + place / kLanes;
            if (block < ranges_[colour][kind].end) { return {block, static_cast<std::uint8_t>(place % kLanes), true}; }
        }
        return {next[kAlone]++, 0, false};
    }

    std::array<Colour, kColourCount> colours_{};
    std::uint32_t blocks_ = 0;
    std::uint32_t rest_ = 0;
    // By joint.
    std::vector<std::uint8_t> jointColours_;
    std::vector<Kind> kinds_;
    std::vector<BlockPlace> places_;
    // By colour: as many joints of each kind, the next place for one, blocks.
    std::array<KindCounts, kColourCount> counts_{};
    std::array<KindCounts, kColourCount> next_{};
    std::array<KindRanges, kColourCount> ranges_{};
};

}  // namespace swept::inline SWEPT_PRECISION
