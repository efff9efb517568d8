#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../solve_report.h"
#include "../solver_batch.h"
#include "direct_joints.h"
#include "direct_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts in a direct solve.
///
/// The damper of a contact only pushes, that of its friction gives way at a limit. As long as that limit is given, the
/// velocities are the minimum of a convex function that is quadratic piece by piece,
///     ½ ΔvᵀMΔv + Σ ψ(J·(v + Δv) + bias),  −ψ′(e) = clamp(λ₀ − k·e, least, most),
/// which Newton's method with a line search finds from anywhere (after Castro, Permenter & Han, "An unconstrained
/// convex formulation of compliant contact", 2022). Limits of friction follow the normal impulses in a few rounds
/// around it.
class DirectContacts {
public:
    /// Once a step. @param hasManyBodies  more rounds
    void begin(std::size_t nodes, bool hasManyBodies);
    /// Each part of the system is searched by itself: what goes to and fro in one holds up no other.
    /// @pre contacts stay where they are until the step ends
    void list(SolverBatch& batch, DirectSystem& system);
    bool isEmpty() const { return points_.empty(); }

    // A sub-step solves contacts twice, each time for a half of what gravity does. These share out their impulses: each
    // solve expects half of what the sub-step before ended with, and at rest finds just that.
    void beginFirstHalf();
    void beginSecondHalf();
    void addHalves();

    /// Before each solve. @param useBias  as in the kernels of the constraints
    void gather(const SolverBatch& batch, Real h, bool useBias);
    /// What presses, what sticks, and how much. @return false where that takes too many rounds
    bool search(DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    /// Whether something is between a kinematic body that comes and what does not yield. @pre search
    bool isSqueezed(const SolverBatch& batch, const DirectSystem& system);
    /// Impulses that were found.
    void write();

    /// Before bodies are moved without speeds: separations of all that presses or overlaps.
    /// @param isLast  of the step: small ones count, too
    /// @return whether some separation is too large
    bool gatherOverlaps(const SolverBatch& batch, const DirectSystem& system, Real h, bool isLast);
    /// The change that moves joints and contacts, as these are held, by their excess, in parts that are too far off.
    /// @pre gatherOverlaps
    /// @param tangentShare  of their strength that rows of friction have
    void computeProjection(DirectSystem& system, const DirectJoints& joints, DirectReport& report, double tangentShare);

    /// What the search cost a body in this step. @param island  the first node of its own
    SearchEffort effortOf(std::uint32_t island) const;

private:
    struct Point {
        ContactConstraint* contact = nullptr;
        ContactConstraintPoint* point = nullptr;
        std::uint32_t island = 0;
        SystemRow normal;
        SystemRow tangent;
        Hold normalHold = Hold::free;
        Hold tangentHold = Hold::free;
        double limit = 0;         ///< of friction
        bool isExpected = false;  ///< to press
        bool isDeep = false;      ///< deeper than a projection pushes out
        int partings = 0;         ///< of a point without a known limit, in this solve
        Real half = 0;            ///< expected normal impulse of half a sub-step
        Real tangentHalf = 0;
        Real first = 0;  ///< impulses of the first half
        Real tangentFirst = 0;
    };
    /// What is searched by itself.
    struct Part {
        NodeRange nodes;
        std::size_t begin = 0;  ///< of its points
        std::size_t end = 0;
        bool isWide = false;         ///< many bodies in loops: see `kFewestOfWide`
        int spareRounds = 0;         ///< since the step began, for what takes more than the usual
        int rounds = 0;              ///< since the step began
        bool mayBeSqueezed = false;  ///< the last search went on for long
        bool isLong = false;         ///< that took more rounds than usual
        bool isInVain = false;       ///< in one of the step: nothing was found
        bool isFar = false;          ///< some separation is too large
        double mostMoved = 0;        ///< metres that a projection may move a body
    };

    void orderByPart(const SolverBatch& batch, const DirectSystem& system);
    void gatherOf(const Part& part, const SolverBatch& batch, Real h, bool useBias);
    void addPoints(SolverBatch& batch, ContactConstraint& contact, DirectSystem& system);
    std::span<Point> pointsOf(const Part& part) {
        return std::span(points_).subspan(part.begin, part.end - part.begin);
    }
    std::span<const Point> pointsOf(const Part& part) const {
        return std::span(points_).subspan(part.begin, part.end - part.begin);
    }
    // direct_overlaps.cpp
    /// Whether there is no room for its bodies. @pre the change of a projection was computed
    bool isOverfull(const Part& part, const DirectSystem& system) const;
    static void limitMoves(const Part& part, DirectSystem& system);
    /// What is done about overlaps and gaps.
    struct Projection {
        Real rate = 0;      ///< part of them that is closed
        Real smallest = 0;  ///< ratio, see `toleranceAt`: what is smaller may stay
    };
    bool gatherOverlapsOf(Part& part, const SolverBatch& batch, const DirectSystem& system,
                          const Projection& projection, Real h);

    // direct_search.cpp
    void assemble(const Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report,
                  double tangentShare = 1);
    void computeChange(const Part& part, DirectSystem& system, const DirectJoints& joints) const;
    static void guessHolds(std::span<Point> points);
    bool takeUpFactor(const Part& part, DirectSystem& system, const DirectJoints& joints) const;
    bool searchPart(Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    bool searchIn(Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    bool settle(const Part& part, DirectSystem& system, const DirectJoints& joints, DirectReport& report);
    void findNoise(const Part& part, const DirectSystem& system);
    bool noted(const Point& point, bool isOther);
    bool classify(const Part& part, const DirectSystem& system, bool isFirm);
    bool followLimits(const Part& part);
    bool tighten(const Part& part);
    double slopeAt(const Part& part, const DirectSystem& system, double share) const;
    double searchLine(const Part& part, const DirectSystem& system);

    bool hasManyBodies_ = false;
    std::vector<Point> points_;  ///< part by part
    std::vector<Part> parts_;
    std::vector<std::uint32_t> partOf_;    ///< by node; scratch of `orderByPart`, as the next one
    std::vector<std::uint32_t> next_;      ///< by part: after the last contact of it in
    std::vector<std::uint32_t> order_;     ///< contacts, part by part
    std::vector<std::uint8_t> holds_;      ///< which of the points were held when the matrix was factorised
    std::int64_t spareBodyRounds_ = 0;     ///< since the step began, of all parts together: by their bodies
    int roundsLeft_ = 0;                   ///< of this search
    int notedFrom_ = 0;                    ///< from so many left on it is noted who takes them
    std::vector<std::uint8_t> takesLong_;  ///< by the first node of an island
    std::vector<Block3> place_;            ///< where the search stands: the last change that was tried
    std::vector<double> noise_;            ///< impulses of no meaning in an island, by its first node
};

}  // namespace swept::inline SWEPT_PRECISION
