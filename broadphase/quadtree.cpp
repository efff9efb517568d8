#include "quadtree.h"

#include <cmath>
#include <limits>

#include "slot_lists.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

constexpr int kMostLevels = 32;
/// Against coordinates, a square is never so small that its borders are lost in rounding.
constexpr double kLeastSquare = 0x1p-40;
/// What loose squares are larger than exact arithmetic asks for.
constexpr double kLooseness = 1 + 0x1p-8;
/// Beyond, sums of coordinates and sides could overflow.
constexpr double kFarthest = static_cast<double>(std::numeric_limits<Real>::max()) * 0x1p-8;

/// Largest coordinate, without its sign.
double farthest(const Aabb& box) {
    const auto size = [](Real x) { return std::fabs(static_cast<double>(x)); };
    return std::max({size(box.lower.x), size(box.lower.y), size(box.upper.x), size(box.upper.y)});
}

}  // namespace

bool Quadtree::Square::holds(const Aabb& box) const {
    const auto left = static_cast<double>(box.lower.x);
    const auto bottom = static_cast<double>(box.lower.y);
    return x - half <= left && left < x + half && y - half <= bottom && bottom < y + half &&
           longerSide(box) <= 2 * half;
}

Quadtree::Quadtree() {
    constexpr Real kMost = std::numeric_limits<Real>::max();
    addSquare(0, 0, 0, 0);
    squares_[0].loose = {{-kMost, -kMost}, {kMost, kMost}};
}

Quadtree::SquareIndex Quadtree::addSquare(double x, double y, double half, SquareIndex parent) {
    SquareIndex index = static_cast<SquareIndex>(squares_.size());
    if (free_.empty()) {
        squares_.emplace_back();
        free_.reserve(squares_.capacity());
    } else {
        index = free_.back();
        free_.pop_back();
    }
    // Corners lie within half a side, and a box reaches no farther up than a side from there.
    const double down = half * kLooseness;
    const double up = 3 * half * kLooseness;
    squares_[index] = {.x = x,
                       .y = y,
                       .half = half,
                       .loose = roundedOutward({x - down, y - down}, {x + up, y + up}),
                       .parent = parent,
                       .first = kEndOfList};
    return index;
}

void Quadtree::growRootOver(const Aabb& box) {
    if (root_ == 0) {
        const double size = std::max(longerSide(box), farthest(box) * kLeastSquare);
        root_ = addSquare(static_cast<double>(box.lower.x), static_cast<double>(box.lower.y), size > 0 ? size : 1, 0);
    }
    while (!squares_[root_].holds(box)) {
        const Square old = squares_[root_];
        const bool right = static_cast<double>(box.lower.x) >= old.x;
        const bool up = static_cast<double>(box.lower.y) >= old.y;
        const SquareIndex grown =
            addSquare(old.x + (right ? old.half : -old.half), old.y + (up ? old.half : -old.half), 2 * old.half, 0);
        // The old root lies on the side that the new one does not grow to.
        squares_[grown].quarters[(right ? 0U : 1U) + (up ? 0U : 2U)] = root_;
        squares_[grown].count = old.count;
        squares_[root_].parent = grown;
        root_ = grown;
    }
}

Quadtree::SquareIndex Quadtree::squareFor(const Aabb& box) {
    if (!(farthest(box) < kFarthest)) { return 0; }
    growRootOver(box);
    const double least = std::max(longerSide(box), farthest(box) * kLeastSquare);
    SquareIndex index = root_;
    for (int level = 0; level < kMostLevels && squares_[index].half >= least; ++level) {
        const Square square = squares_[index];
        const bool right = static_cast<double>(box.lower.x) >= square.x;
        const bool up = static_cast<double>(box.lower.y) >= square.y;
        const std::size_t quarter = (right ? 1U : 0U) + (up ? 2U : 0U);
        if (square.quarters[quarter] == 0) {
            const double half = square.half / 2;
            const SquareIndex added =
                addSquare(square.x + (right ? half : -half), square.y + (up ? half : -half), half, index);
            squares_[index].quarters[quarter] = added;
        }
        index = squares_[index].quarters[quarter];
    }
    return index;
}

void Quadtree::put(std::uint32_t slot) {
    const SquareIndex index = squareFor(table().boxAt(slot));
    Square& square = squares_[index];
    standsIn_[slot] = index;
    next_[slot] = square.first;
    previous_[slot] = kEndOfList;
    if (square.first != kEndOfList) { previous_[square.first] = slot; }
    square.first = slot;
    for (SquareIndex i = index; i != 0; i = squares_[i].parent) { ++squares_[i].count; }
}

void Quadtree::takeOut(std::uint32_t slot) {
    const SquareIndex index = standsIn_[slot];
    const std::uint32_t next = next_[slot];
    const std::uint32_t previous = previous_[slot];
    if (next != kEndOfList) { previous_[next] = previous; }
    (previous != kEndOfList ? next_[previous] : squares_[index].first) = next;
    for (SquareIndex i = index; i != 0;) {
        const SquareIndex parent = squares_[i].parent;
        if (--squares_[i].count == 0) {
            for (SquareIndex& quarter : squares_[parent].quarters) {
                if (quarter == i) { quarter = 0; }
            }
            if (i == root_) { root_ = 0; }
            free_.push_back(i);
        }
        i = parent;
    }
}

void Quadtree::onInsert(std::uint32_t slot) {
    if (slot == standsIn_.size()) {
        standsIn_.push_back(0);
        next_.push_back(kEndOfList);
        previous_.push_back(kEndOfList);
    }
    put(slot);
}

void Quadtree::onMove(std::uint32_t slot) {
    if (standsIn_[slot] != 0 && squares_[standsIn_[slot]].holds(table().boxAt(slot))) { return; }
    takeOut(slot);
    put(slot);
}

template <class Offer>
bool Quadtree::offerBelow(SquareIndex index, const Aabb& box, const Offer& offer) const {
    const Square& square = squares_[index];
    if (!overlaps(square.loose, box)) { return true; }
    for (std::uint32_t slot = square.first; slot != kEndOfList; slot = next_[slot]) {
        if (!offer(slot)) { return false; }
    }
    for (const SquareIndex quarter : square.quarters) {
        if (quarter != 0 && !offerBelow(quarter, box, offer)) { return false; }
    }
    return true;
}

std::uint64_t Quadtree::join(PairSink& sink, TaskSystem& /*loops*/) {
    std::uint64_t tests = 0;
    for (const std::uint32_t a : table().sortedMoved()) {
        const Aabb box = table().boxAt(a);
        const std::uint8_t meeting = meetingKinds(table().kindOf(static_cast<ProxyId>(a)));
        const auto offer = [&](std::uint32_t b) {
            ++tests;
            const bool meets = overlaps(box, table().boxAt(b)) && (meeting & table().bitAt(b)) != 0;
            const bool seenFromThere = b <= a && table().hasMoved(b);
            if (meets && !seenFromThere) { sink.add(a, b); }
            return true;
        };
        offerBelow(0, box, offer);
        if (root_ != 0) { offerBelow(root_, box, offer); }
    }
    return tests;
}

std::uint64_t Quadtree::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    const auto offer = [&](std::uint32_t slot) {
        ++tests;
        return !overlaps(box, table().boxAt(slot)) || visit(static_cast<ProxyId>(slot));
    };
    if (offerBelow(0, box, offer) && root_ != 0) { offerBelow(root_, box, offer); }
    return tests;
}

void Quadtree::walkBelow(SquareIndex index, SweepVisit& visit) const {
    const Square& square = squares_[index];
    if (!visit.meets(square.loose)) { return; }
    for (std::uint32_t slot = square.first; slot != kEndOfList && !visit.isOver(); slot = next_[slot]) {
        if (visit.meets(table().boxAt(slot))) { visit.show(slot); }
    }
    for (const SquareIndex quarter : square.quarters) {
        if (quarter != 0 && !visit.isOver()) { walkBelow(quarter, visit); }
    }
}

void Quadtree::visitAlong(SweepVisit& visit) const {
    if (squares_[0].first != kEndOfList) { walkBelow(0, visit); }
    if (root_ != 0 && !visit.isOver()) { walkBelow(root_, visit); }
}

std::size_t Quadtree::structureBytes() const {
    return bytesOf(squares_) + bytesOf(free_) + bytesOf(standsIn_) + bytesOf(next_) + bytesOf(previous_);
}

}  // namespace swept::inline SWEPT_PRECISION
