#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "constraint_graph.h"

namespace swept::inline SWEPT_PRECISION {

/// A range over several lists that are counted through one after the other, cut into a range of each.
class RangeCut {
public:
    RangeCut(std::size_t begin, std::size_t end) : begin_(begin), end_(end) {}

    /// Whether nothing is cut off the lists, which hold so many in all.
    bool isWhole(std::size_t count) const { return begin_ == 0 && end_ >= count; }

    /// What of the next list, which stands at `range` of an array, is inside.
    ColourRange next(ColourRange range) {
        const std::size_t count = range.end - range.begin;
        const std::size_t begin = std::min(begin_, count);
        const std::size_t end = std::min(end_, count);
        begin_ -= begin;
        end_ -= end;
        return {range.begin + static_cast<std::uint32_t>(begin), range.begin + static_cast<std::uint32_t>(end)};
    }
    template <class T>
    std::span<T> next(std::vector<T>& all, ColourRange range) {
        const ColourRange inside = next(range);
        return std::span<T>(all).subspan(inside.begin, inside.end - inside.begin);
    }

private:
    std::size_t begin_;
    std::size_t end_;
};

}  // namespace swept::inline SWEPT_PRECISION
