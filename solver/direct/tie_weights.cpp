#include "tie_weights.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kNotWeighed = -1;

}  // namespace

void TieWeights::find(std::span<const Member> members, std::span<const Link> links) {
    listNeighbours(members.size(), links);
    places_.resize(members.size());
    inertias_.assign(members.size(), kNotWeighed);
    for (std::uint32_t i = 0; i < members.size(); ++i) {
        if (inertias_[i] == kNotWeighed) { weighTie(members, i); }
    }
}

void TieWeights::listNeighbours(std::size_t members, std::span<const Link> links) {
    begins_.assign(members + 2, 0);
    for (const Link& link : links) {
        ++begins_[link.a + 2];
        ++begins_[link.b + 2];
    }
    for (std::size_t i = 2; i < begins_.size(); ++i) { begins_[i] += begins_[i - 1]; }
    neighbours_.resize(2 * links.size());
    for (const Link& link : links) {
        neighbours_[begins_[link.a + 1]++] = {link.b, link.offset};
        neighbours_[begins_[link.b + 1]++] = {link.a, -link.offset};
    }
}

void TieWeights::weighTie(std::span<const Member> members, std::uint32_t first) {
    tie_.assign(1, first);
    places_[first] = {};
    inertias_[first] = 0;
    double mass = 0;
    double own = 0;
    DVec2 moment;
    double square = 0;
    for (std::size_t i = 0; i < tie_.size(); ++i) {  // grows as it goes
        const std::uint32_t member = tie_[i];
        const DVec2 place = places_[member];
        mass += members[member].mass;
        own += members[member].inertia;
        moment += members[member].mass * place;
        square += members[member].mass * dot(place, place);
        for (std::uint32_t k = begins_[member]; k < begins_[member + 1]; ++k) {
            const Neighbour& neighbour = neighbours_[k];
            if (inertias_[neighbour.member] != kNotWeighed) { continue; }
            inertias_[neighbour.member] = 0;
            places_[neighbour.member] = place + neighbour.offset;
            tie_.push_back(neighbour.member);
        }
    }
    for (const std::uint32_t member : tie_) {
        const DVec2 place = places_[member];
        // Rounding may leave a little less than nothing of points about their own centre.
        const double ofPlaces = square - 2 * dot(moment, place) + mass * dot(place, place);
        inertias_[member] = own + std::max(ofPlaces, 0.0);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
