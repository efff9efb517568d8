#include "row_changes.h"

#include <algorithm>
#include <cmath>

#include "direct_parts.h"

namespace swept::inline SWEPT_PRECISION {

void RowChanges::add(const BlockLdlt& factor, NodeRange part, std::span<const End> ends, double k) {
    if (ordered_.size() < part.end) { ordered_.resize(part.end); }
    std::fill(ordered_.begin() + part.begin, ordered_.begin() + part.end, Block3{});
    std::uint32_t first = part.end;
    for (const End& end : ends) {
        const std::uint32_t place = factor.positionOf(end.node);
        addScaled(ordered_[place], 1, end.of);
        first = std::min(first, place);
    }
    if (changes_.size() == count_) { changes_.emplace_back(); }
    Change& change = changes_[count_++];
    change.k = k;
    change.places.clear();
    change.reduced.clear();
    change.divided.clear();
    for (std::uint32_t place = first; place < part.end; ++place) {
        const Block3 value = ordered_[place];
        if (value == Block3{}) { continue; }
        factor.eliminate(place, ordered_);
        change.places.push_back(place);
        change.reduced.push_back(value);
        change.divided.push_back(factor.divided(place, value));
    }
}

double RowChanges::along(const Change& change, std::span<const Block3> ordered) const {
    double sum = 0;
    for (std::size_t i = 0; i < change.places.size(); ++i) {
        sum += dot3(change.divided[i], ordered[change.places[i]]);
    }
    return sum;
}

/// Gaussian elimination with the largest pivot: what left makes the matrix indefinite.
bool RowChanges::findShares() {
    const std::size_t n = count_;
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r) {
            if (std::fabs(couplings_[r * n + c]) > std::fabs(couplings_[pivot * n + c])) { pivot = r; }
        }
        if (!(std::fabs(couplings_[pivot * n + c]) > 0)) { return false; }
        for (std::size_t i = c; i < n && pivot != c; ++i) {
            std::swap(couplings_[c * n + i], couplings_[pivot * n + i]);
        }
        std::swap(shares_[c], shares_[pivot]);
        for (std::size_t r = c + 1; r < n; ++r) {
            const double factor = couplings_[r * n + c] / couplings_[c * n + c];
            for (std::size_t i = c + 1; i < n; ++i) { couplings_[r * n + i] -= factor * couplings_[c * n + i]; }
            shares_[r] -= factor * shares_[c];
        }
    }
    for (std::size_t c = n; c-- > 0;) {
        for (std::size_t i = c + 1; i < n; ++i) { shares_[c] -= couplings_[c * n + i] * shares_[i]; }
        shares_[c] /= couplings_[c * n + c];
    }
    return true;
}

void RowChanges::solve(const BlockLdlt& factor, std::span<Block3> values, NodeRange part) {
    const std::size_t n = count_;
    couplings_.resize(n * n);
    shares_.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
        std::fill(ordered_.begin() + part.begin, ordered_.begin() + part.end, Block3{});
        const Change& change = changes_[c];
        for (std::size_t i = 0; i < change.places.size(); ++i) { ordered_[change.places[i]] = change.reduced[i]; }
        for (std::size_t r = 0; r <= c; ++r) {
            couplings_[r * n + c] = couplings_[c * n + r] = along(changes_[r], ordered_);
        }
        couplings_[c * n + c] += 1 / change.k;
    }
    factor.beginSolve(values, ordered_, part);
    for (std::size_t c = 0; c < n; ++c) { shares_[c] = along(changes_[c], ordered_); }
    // Neither matrix is singular, so this one is not. If rounding made it so, the old factor leads down, too.
    if (findShares()) {
        for (std::size_t c = 0; c < n; ++c) {
            const Change& change = changes_[c];
            for (std::size_t i = 0; i < change.places.size(); ++i) {
                addScaled(ordered_[change.places[i]], -shares_[c], change.reduced[i]);
            }
        }
    }
    factor.endSolve(values, ordered_, part);
}

}  // namespace swept::inline SWEPT_PRECISION
