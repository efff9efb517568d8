#include "grid.h"

#include <bit>
#include <cmath>
#include <limits>

#include "slot_lists.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

constexpr std::uint32_t kFewestBuckets = 16;

constexpr std::int32_t kLastCell = 2'000'000'000;

/// Which cell along an axis. Never decreasing in x, which is what finding depends on; beyond the last cell everything
/// shares it.
std::int32_t indexOf(Real x, double cell) {
    constexpr double kMost = kLastCell;
    return static_cast<std::int32_t>(std::clamp(std::floor(static_cast<double>(x) / cell), -kMost, kMost));
}

/// A box longer than this part of a cell is a giant; the rest covers the rounding of the two cells between which it
/// lies.
constexpr double kFullCell = 1 - 0x1p-10;

}  // namespace

Grid::Grid() : buckets_(kFewestBuckets, kEndOfList), firstGiant_(kEndOfList) {}

Grid::Cell Grid::cellAt(Vec2 point) const { return {indexOf(point.x, cell_), indexOf(point.y, cell_)}; }

std::uint32_t Grid::bucketOf(Cell cell) const {
    // Two odd multipliers that have little in common; the high bits of a product depend on all bits of its factors.
    const std::uint64_t x = static_cast<std::uint32_t>(cell.x) * 0x9E3779B97F4A7C15ULL;
    const std::uint64_t y = static_cast<std::uint32_t>(cell.y) * 0xC2B2AE3D27D4EB4FULL;
    return static_cast<std::uint32_t>((x ^ std::rotl(y, 32)) >> 32) & static_cast<std::uint32_t>(buckets_.size() - 1);
}

std::uint32_t& Grid::listOf(std::uint32_t slot) {
    return isGiant_[slot] != 0 ? firstGiant_ : buckets_[bucketOf(cells_[slot])];
}

void Grid::file(std::uint32_t slot) {
    const Aabb& box = table().boxAt(slot);
    isGiant_[slot] = longerSide(box) <= cell_ * kFullCell ? 0 : 1;
    cells_[slot] = cellAt(box.lower);
    std::uint32_t& head = listOf(slot);
    next_[slot] = head;
    previous_[slot] = kEndOfList;
    if (head != kEndOfList) { previous_[head] = slot; }
    head = slot;
    giants_ += isGiant_[slot];
    ++filed_;
    used_.first = {std::min(used_.first.x, cells_[slot].x), std::min(used_.first.y, cells_[slot].y)};
    used_.last = {std::max(used_.last.x, cells_[slot].x), std::max(used_.last.y, cells_[slot].y)};
}

void Grid::takeOut(std::uint32_t slot) {
    const std::uint32_t next = next_[slot];
    const std::uint32_t previous = previous_[slot];
    if (next != kEndOfList) { previous_[next] = previous; }
    (previous != kEndOfList ? next_[previous] : listOf(slot)) = next;
    giants_ -= isGiant_[slot];
    --filed_;
}

void Grid::onInsert(std::uint32_t slot) {
    if (slot == next_.size()) {
        next_.push_back(kEndOfList);
        previous_.push_back(kEndOfList);
        cells_.push_back({});
        isGiant_.push_back(0);
    }
    file(slot);
}

void Grid::onMove(std::uint32_t slot) {
    takeOut(slot);
    file(slot);
}

bool Grid::isRefilingDue() const {
    constexpr std::uint32_t kGiantsForFree = 16;
    const bool isCrowded = filed_ > buckets_.size();
    const bool isEmpty = buckets_.size() > kFewestBuckets && filed_ < buckets_.size() / 8;
    return isCrowded || isEmpty || giants_ > 2 * giantsAtRefiling_ + kGiantsForFree;
}

void Grid::chooseCell() {
    constexpr std::size_t kBoxesPerGiant = 64;
    constexpr double kRoom = 1.125;  // sizes of boxes vary a little while they turn
    sizes_.clear();
    for (std::uint32_t slot = 0; slot < table().slotCount(); ++slot) {
        if (table().bitAt(slot) != 0) { sizes_.push_back(longerSide(table().boxAt(slot))); }
    }
    if (sizes_.empty()) {
        cell_ = 1;
        return;
    }
    const auto limit = sizes_.end() - 1 - static_cast<std::ptrdiff_t>(sizes_.size() / kBoxesPerGiant);
    std::nth_element(sizes_.begin(), limit, sizes_.end());
    // Points alone have no size: any cell is as good as another.
    cell_ = *limit > 0 && *limit < std::numeric_limits<double>::max() ? kRoom * *limit : 1;
}

void Grid::refileAll() {
    chooseCell();
    buckets_.assign(std::max(kFewestBuckets, 2 * std::bit_ceil(filed_)), kEndOfList);
    firstGiant_ = kEndOfList;
    giants_ = 0;
    filed_ = 0;
    used_ = {{kLastCell, kLastCell}, {-kLastCell, -kLastCell}};
    for (std::uint32_t slot = 0; slot < table().slotCount(); ++slot) {
        if (table().bitAt(slot) != 0) { file(slot); }
    }
    giantsAtRefiling_ = giants_;
    countRebuild();
}

template <class Offer>
bool Grid::offerCell(Cell cell, const Offer& offer) const {
    for (std::uint32_t slot = buckets_[bucketOf(cell)]; slot != kEndOfList; slot = next_[slot]) {
        if (cells_[slot] == cell && !offer(slot)) { return false; }  // lists may be shared by several cells
    }
    return true;
}

template <class Offer>
void Grid::offerAround(const Aabb& box, const Offer& offer) const {
    const Cell first = {cellAt(box.lower).x - 1, cellAt(box.lower).y - 1};
    const Cell last = cellAt(box.upper);
    const double columns = static_cast<double>(last.x) - first.x + 1;
    const double rows = static_cast<double>(last.y) - first.y + 1;
    if (!(columns * rows <= filed_)) {
        for (std::uint32_t slot = 0; slot < table().slotCount(); ++slot) {
            if (table().bitAt(slot) != 0 && !offer(slot)) { return; }
        }
        return;
    }
    for (std::int32_t y = first.y; y <= last.y; ++y) {
        for (std::int32_t x = first.x; x <= last.x; ++x) {
            if (!offerCell({x, y}, offer)) { return; }
        }
    }
    for (std::uint32_t slot = firstGiant_; slot != kEndOfList; slot = next_[slot]) {
        if (!offer(slot)) { return; }
    }
}

std::uint64_t Grid::join(PairSink& sink, TaskSystem& /*loops*/) {
    if (isRefilingDue()) { refileAll(); }
    std::uint64_t tests = 0;
    for (const std::uint32_t a : table().sortedMoved()) {
        const Aabb box = table().boxAt(a);
        const std::uint8_t meeting = meetingKinds(table().kindOf(static_cast<ProxyId>(a)));
        offerAround(box, [&](std::uint32_t b) {
            ++tests;
            const bool meets = overlaps(box, table().boxAt(b)) && (meeting & table().bitAt(b)) != 0;
            const bool seenFromThere = b <= a && table().hasMoved(b);
            if (meets && !seenFromThere) { sink.add(a, b); }
            return true;
        });
    }
    return tests;
}

std::uint64_t Grid::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    offerAround(box, [&](std::uint32_t slot) {
        ++tests;
        return !overlaps(box, table().boxAt(slot)) || visit(static_cast<ProxyId>(slot));
    });
    return tests;
}

void Grid::visitAlong(SweepVisit& visit) const {
    if (filed_ == 0) { return; }  // then `used_` may be no range at all: halving it would go on for ever
    for (std::uint32_t slot = firstGiant_; slot != kEndOfList; slot = next_[slot]) {
        if (visit.meets(table().boxAt(slot))) { visit.show(slot); }
        if (visit.isOver()) { return; }
    }
    const double columns = static_cast<double>(used_.last.x) - used_.first.x;
    const double rows = static_cast<double>(used_.last.y) - used_.first.y;
    if (columns + rows < filed_) {
        walkCells(used_, visit);
        return;
    }
    for (std::uint32_t slot = 0; slot < table().slotCount() && !visit.isOver(); ++slot) {
        if (table().bitAt(slot) != 0 && isGiant_[slot] == 0 && visit.meets(table().boxAt(slot))) { visit.show(slot); }
    }
}

/// Halves a range of cells as long as the sweep meets it, down to single cells: about as many as it passes through.
void Grid::walkCells(const CellRange& cells, SweepVisit& visit) const {
    // What is filed in a cell ends before the one after the next; one more cell on each side covers rounding.
    const auto edge = [this](std::int32_t index, int beyond) {
        constexpr double kMost = static_cast<double>(std::numeric_limits<Real>::max());
        if (index == -kLastCell || index == kLastCell) { return static_cast<Real>(beyond < 0 ? -kMost : kMost); }
        return static_cast<Real>(std::clamp((static_cast<double>(index) + beyond) * cell_, -kMost, kMost));
    };
    const Aabb all = {{edge(cells.first.x, -1), edge(cells.first.y, -1)},
                      {edge(cells.last.x, 3), edge(cells.last.y, 3)}};
    if (visit.isOver() || !visit.meets(all)) { return; }
    const std::int64_t columns = std::int64_t{cells.last.x} - cells.first.x;
    const std::int64_t rows = std::int64_t{cells.last.y} - cells.first.y;
    if (columns == 0 && rows == 0) {
        offerCell(cells.first, [&](std::uint32_t slot) {
            if (isGiant_[slot] == 0 && visit.meets(table().boxAt(slot))) { visit.show(slot); }
            return !visit.isOver();
        });
        return;
    }
    CellRange lower = cells;
    CellRange upper = cells;
    if (columns >= rows) {
        lower.last.x = static_cast<std::int32_t>(cells.first.x + columns / 2);
        upper.first.x = lower.last.x + 1;
    } else {
        lower.last.y = static_cast<std::int32_t>(cells.first.y + rows / 2);
        upper.first.y = lower.last.y + 1;
    }
    walkCells(lower, visit);
    walkCells(upper, visit);
}

std::size_t Grid::structureBytes() const {
    return bytesOf(buckets_) + bytesOf(next_) + bytesOf(previous_) + bytesOf(cells_) + bytesOf(isGiant_) +
           bytesOf(sizes_);
}

}  // namespace swept::inline SWEPT_PRECISION
