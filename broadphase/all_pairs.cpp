#include "all_pairs.h"

namespace swept::inline SWEPT_PRECISION {

std::uint64_t AllPairs::join(PairSink& sink, TaskSystem& /*loops*/) {
    std::uint64_t tests = 0;
    for (const std::uint32_t a : table().sortedMoved()) {
        const Aabb box = table().boxAt(a);
        const std::uint8_t meeting = meetingKinds(table().kindOf(static_cast<ProxyId>(a)));
        for (std::uint32_t b = 0; b < table().slotCount(); ++b) {
            if ((meeting & table().bitAt(b)) == 0) { continue; }
            if (b <= a && table().hasMoved(b)) { continue; }  // itself, or seen from b
            ++tests;
            if (overlaps(box, table().boxAt(b))) { sink.add(a, b); }
        }
    }
    return tests;
}

std::uint64_t AllPairs::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    for (std::uint32_t slot = 0; slot < table().slotCount(); ++slot) {
        if (table().bitAt(slot) == 0) { continue; }
        ++tests;
        if (overlaps(box, table().boxAt(slot)) && !visit(static_cast<ProxyId>(slot))) { break; }
    }
    return tests;
}

void AllPairs::visitAlong(SweepVisit& visit) const {
    for (std::uint32_t slot = 0; slot < table().slotCount(); ++slot) {
        if (table().bitAt(slot) == 0 || !visit.meets(table().boxAt(slot))) { continue; }
        visit.show(slot);
        if (visit.isOver()) { return; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
