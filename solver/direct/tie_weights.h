#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/dvec2.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// How hard it is to turn all that joints tie together, as if it were one rigid body: what holds an angle between two
/// of these bodies may have to turn that, not only the two.
class TieWeights {
public:
    struct Member {
        double mass = 0;     ///< kg; 0: cannot be moved
        double inertia = 0;  ///< kg·m²
    };
    /// Two members that a joint holds.
    struct Link {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        DVec2 offset{};  ///< centre of mass of B minus that of A, metres
    };

    /// In proportion to members and links.
    void find(std::span<const Member> members, std::span<const Link> links);

    /// Of all that is linked with the member, about its centre of mass, kg·m².
    double inertiaAbout(std::uint32_t member) const { return inertias_[member]; }

private:
    void listNeighbours(std::size_t members, std::span<const Link> links);
    void weighTie(std::span<const Member> members, std::uint32_t first);

    struct Neighbour {
        std::uint32_t member = 0;
        DVec2 offset{};
    };
    std::vector<std::uint32_t> begins_;  ///< by member: its neighbours
    std::vector<Neighbour> neighbours_;
    std::vector<std::uint32_t> tie_;  ///< scratch: members of one
    std::vector<DVec2> places_;       ///< centres of mass from that of the first one of the tie, metres
    std::vector<double> inertias_;    ///< negative: not yet found
};

}  // namespace swept::inline SWEPT_PRECISION
