#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "../../shapes/dvec2.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What acts on a body: a force, and a torque over some lever, so that the three compare.
struct Wrench {
    DVec2 force{};
    double twist = 0;

    Wrench& operator+=(const Wrench& other) {
        force += other.force;
        twist += other.twist;
        return *this;
    }
};

/// Of all ways in which contacts of one body may push it so that nothing is left of a given load, the one nearest to
/// how they pushed before. A push within a cone of friction is the sum of two along its edges, neither of them
/// negative; so this is the smallest change of those, x = max(0, x₀ + Gᵀy), with three unknowns y, found by Newton's
/// method on the convex function, quadratic piece by piece, of which G·x + load is the slope. Damped where the contacts
/// do not fix all three, as those of a ball.
///
/// Forces in any unit, of which all results are multiples: nothing here has a scale of its own.
class ConeBalance {
public:
    void reserve(std::size_t edges) { edges_.reserve(edges); }
    void clear() { edges_.clear(); }
    /// @param edge  of the push on the body, of any length; twist over the lever of the load
    /// @param before  part of the push along that edge
    void addEdge(const Wrench& edge, double before) { edges_.push_back({edge, before, 0}); }
    /// @param turns  false: the body takes any torque
    /// @param wanted  what may be left of the load
    /// @return the largest of force and twist that is left of it: more than wanted if that is all there is
    double solve(const Wrench& load, bool turns, double wanted);
    /// Of an edge, by the order of adding them; at least 0.
    double part(std::size_t edge) const { return edges_[edge].part; }

private:
    using Triple = std::array<double, 3>;
    struct Edge {
        Wrench direction;
        double before;
        double part;
    };
    struct Trial {
        Triple at{};    ///< y
        Triple left{};  ///< slope there: what is left of the load
        double value = 0;
    };

    Trial trialAt(const Wrench& load, const Triple& at) const;
    bool findStep(const Trial& trial, double damping, Triple& step) const;

    std::vector<Edge> edges_;
    bool turns_ = true;
};

}  // namespace swept::inline SWEPT_PRECISION
