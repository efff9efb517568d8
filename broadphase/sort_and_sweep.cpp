#include "sort_and_sweep.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Entries under one hull: few enough to look at all of them, many enough to skip most.
constexpr std::size_t kBlock = 64;

/// About the first of them: far from the origin the squares would leave nothing of their difference.
struct Variance {
    double first;
    double sum = 0;
    double squares = 0;
    void add(double x) {
        sum += x - first;
        squares += (x - first) * (x - first);
    }
    double of(double count) const { return squares - sum * sum / count; }
};

}  // namespace

Real SortAndSweep::keyOf(std::uint32_t slot) const {
    const Vec2 lower = table().boxAt(slot).lower;
    return alongY_ ? lower.y : lower.x;
}

std::uint64_t SortAndSweep::join(PairSink& sink, TaskSystem& /*loops*/) {
    renewEntries();
    chooseAxis();
    repairOrder();
    prepareScans();
    return scan(movedQueries_, all_, sink) + scan(restedQueries_, moved_, sink);
}

/// Drops what is gone, adds what is new, and reads the keys of what moved.
void SortAndSweep::renewEntries() {
    std::vector<Entry>& entries = all_.entries;
    isListed_.resize(table().slotCount(), 0);
    std::erase_if(entries, [this](const Entry& entry) {
        const bool gone = table().bitAt(entry.slot) == 0;
        if (gone) { isListed_[entry.slot] = 0; }
        return gone;
    });
    for (Entry& entry : entries) {
        if (table().hasMoved(entry.slot)) { entry.key = keyOf(entry.slot); }
    }
    const std::size_t before = entries.size();
    for (const std::uint32_t slot : table().listedMoved()) {
        if (table().bitAt(slot) == 0 || isListed_[slot] != 0) { continue; }
        isListed_[slot] = 1;
        entries.push_back({keyOf(slot), slot});
    }
    // So many at once would each walk half of the list.
    constexpr std::size_t kFewPerNew = 16;
    if ((entries.size() - before) * kFewPerNew > entries.size()) { isSorted_ = false; }
}

void SortAndSweep::chooseAxis() {
    if (all_.entries.empty()) { return; }
    const auto middleOf = [this](const Entry& entry) {
        const Aabb& box = table().boxAt(entry.slot);
        return 0.5 * toDouble(box.lower) + 0.5 * toDouble(box.upper);
    };
    const DVec2 first = middleOf(all_.entries.front());
    Variance x{first.x};
    Variance y{first.y};
    for (const Entry& entry : all_.entries) {
        const DVec2 middle = middleOf(entry);
        x.add(middle.x);
        y.add(middle.y);
    }
    constexpr double kClearly = 2;
    const auto count = static_cast<double>(all_.entries.size());
    const double here = (alongY_ ? y : x).of(count);
    const double there = (alongY_ ? x : y).of(count);
    if (!(there > kClearly * here)) { return; }
    alongY_ = !alongY_;
    for (Entry& entry : all_.entries) { entry.key = keyOf(entry.slot); }
    isSorted_ = false;
}

void SortAndSweep::repairOrder() {
    const auto before = [](const Entry& a, const Entry& b) { return a.key < b.key; };
    std::vector<Entry>& entries = all_.entries;
    if (!isSorted_) { std::sort(entries.begin(), entries.end(), before); }
    isSorted_ = true;
    // An insertion sort that gives up when it has moved more than a sort from scratch would.
    constexpr std::size_t kBudgetPerEntry = 16;
    std::size_t budget = kBudgetPerEntry * entries.size();
    for (std::size_t i = 1; i < entries.size(); ++i) {
        const Entry entry = entries[i];
        std::size_t place = i;
        for (; place > 0 && entry.key < entries[place - 1].key; --place) { entries[place] = entries[place - 1]; }
        entries[place] = entry;
        if (i - place > budget) {
            std::sort(entries.begin(), entries.end(), before);
            return;
        }
        budget -= i - place;
    }
}

void SortAndSweep::Sorted::pack(const ProxyTable& table) {
    boxes.assign((entries.size() + kLaneMask) >> kLaneBits, WideBoxes::empty());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        boxes[i >> kLaneBits].set(i & kLaneMask, table.boxAt(entries[i].slot));
    }
}

/// Boxes in order, hulls for queries, and who asks whom: of a pair, the one that comes first in the order looks for the
/// other; what moved among all, and the rest among what moved.
void SortAndSweep::prepareScans() {
    moved_.entries.clear();
    movedQueries_.clear();
    restedQueries_.clear();
    blocks_.clear();
    for (std::uint32_t i = 0; i < all_.entries.size(); ++i) {
        const Entry& entry = all_.entries[i];
        const Aabb& box = table().boxAt(entry.slot);
        if (table().hasMoved(entry.slot)) {
            moved_.entries.push_back(entry);
            movedQueries_.push_back({box, i + 1, entry.slot});
        } else {
            restedQueries_.push_back({box, static_cast<std::uint32_t>(moved_.entries.size()), entry.slot});
        }
        if (i % kBlock == 0) { blocks_.push_back(kNoBox); }
        blocks_.back() = hullOf(blocks_.back(), box);
    }
    all_.pack(table());
    moved_.pack(table());
}

std::uint64_t SortAndSweep::scan(const std::vector<IntervalQuery>& queries, const Sorted& others, PairSink& sink) {
    hits_.clear();
    const std::uint64_t tests = widestKernels().intervals({others.boxes, queries, alongY_, &hits_});
    for (const IntervalHit& hit : hits_) {
        const std::uint32_t partner = others.entries[hit.place].slot;
        if ((meetingKinds(table().kindOf(static_cast<ProxyId>(hit.id))) & table().bitAt(partner)) != 0) {
            sink.add(hit.id, partner);
        }
    }
    return tests;
}

std::uint64_t SortAndSweep::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    const auto offer = [&](std::uint32_t slot) {
        ++tests;
        return !overlaps(box, table().boxAt(slot)) || visit(static_cast<ProxyId>(slot));
    };
    for (const std::uint32_t slot : table().listedMoved()) {
        if (table().bitAt(slot) != 0 && !offer(slot)) { return tests; }
    }
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
        ++tests;
        if (!overlaps(box, blocks_[block])) { continue; }
        const std::size_t end = std::min((block + 1) * kBlock, all_.entries.size());
        for (std::size_t i = block * kBlock; i < end; ++i) {
            if (isCurrent(all_.entries[i].slot) && !offer(all_.entries[i].slot)) { return tests; }
        }
    }
    return tests;
}

void SortAndSweep::visitAlong(SweepVisit& visit) const {
    const auto offer = [&](std::uint32_t slot) {
        if (visit.meets(table().boxAt(slot))) { visit.show(slot); }
        return !visit.isOver();
    };
    for (const std::uint32_t slot : table().listedMoved()) {
        if (table().bitAt(slot) != 0 && !offer(slot)) { return; }
    }
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
        if (!visit.meets(blocks_[block])) { continue; }
        const std::size_t end = std::min((block + 1) * kBlock, all_.entries.size());
        for (std::size_t i = block * kBlock; i < end; ++i) {
            if (isCurrent(all_.entries[i].slot) && !offer(all_.entries[i].slot)) { return; }
        }
    }
}

std::size_t SortAndSweep::structureBytes() const {
    std::size_t sum =
        bytesOf(isListed_) + bytesOf(blocks_) + bytesOf(movedQueries_) + bytesOf(restedQueries_) + bytesOf(hits_);
    for (const Sorted* sorted : {&all_, &moved_}) { sum += bytesOf(sorted->entries) + bytesOf(sorted->boxes); }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
