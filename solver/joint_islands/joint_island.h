#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "../../shapes/dvec2.h"
#include "../direct/block_ldlt.h"
#include "island_drive.h"
#include "joint_flow.h"
#include "joint_island_parts.h"

namespace swept::inline SWEPT_PRECISION {

/// Where joints cannot all hold, what moves by itself leads bodies up to eight times as fast as if they went along.
inline constexpr double kMostLead = 64;  ///< of energies

/// Bodies that nothing but rigid joints holds together, through a step, in double.
///
/// Trees go by `JointFlow` where it may take them and what it does keeps energy. For the others:
///
/// A sub-step is one of RATTLE (Andersen 1983): half of the drive, impulses such that the motion ends where all holds
/// are right, the motion, the other half, impulses that leave no speed against them. Solved to rounding it is symmetric
/// in time and symplectic, so energy has no way to drift. Sub-steps are put together with lengths of both signs to a
/// method of the fourth order (Suzuki 1990). Where their number follows the motion that symmetry is lost, and the
/// energy of what hangs on something fixed is put right after the step.
///
/// The impulses are found as `DirectSolver` does, by a damper per row and the method of multipliers, with one
/// factorisation for both solves at a place: errors of places are put in again until they are gone (Newton's method
/// with the matrix of the start).
///
/// That is explicit in the directions of forces, and unstable where light links under a heavy load's tension oscillate
/// faster than twice in a radian. Sub-steps of trees go by their middle there: forces act in the direction between
/// where the sub-step begins and where it ends, so that they do no work (a discrete gradient: Gonzalez 1996, "Time
/// integration and discrete Hamiltonian systems"). Energy is kept to rounding at any length of a sub-step, and what
/// oscillates too fast to be followed stays as wide as it is. How forces turn with the bodies is part of the matrix.
///
/// Where Newton's method finds no end (a slack chain of light links is drawn tight within a sub-step), forces have the
/// direction that the sub-step ends with: the motion is the nearest one to the free one that joints allow, and loses
/// the energy of the jerk. In loops there may be no end to find: a straight bridge between two posts cannot hold its
/// weight. Then the step is done with sub-steps of the first order, whose rows give way.
///
/// Bodies of trees that were put apart come together by being moved, part of the way in each step, without speeds.
class JointIsland {
public:
    void clear();
    std::vector<IslandBody>& bodies() { return bodies_; }
    std::vector<IslandHold>& holds() { return holds_; }
    std::vector<IslandDrive>& drives() { return drives_; }

    /// Some hold is moved in this step, at so many m/s, so energy does not tell whether it went wrong.
    void allowWork(double speed) { woundSpeed_ = std::max(woundSpeed_, speed); }
    /// Some rod may have a pace. @pre `allowWork`
    void allowPace() { isPaced_ = true; }
    /// Some drive will not stay what it is in this step: it is not to be taken.
    void refuse() { isUndone_ = true; }
    /// @pre bodies, holds and drives are filled in, forces with those of the step before
    void prepare();
    /// @param h  of a sub-step that drives of bodies were made for
    /// @param flow  scratch
    void advance(double h, int subSteps, JointFlow& flow);
    /// Nothing took it through the step: joints that have drives are followed by `JointFlow`, or not at all.
    bool isUndone() const { return isUndone_; }
    int factorisations() const { return factorisations_; }
    int subSteps() const { return subSteps_; }  ///< that the step took
    std::size_t movedBodies() const { return columns_; }
    bool isTree() const { return isTree_; }                     ///< no joint closes a loop
    bool isFree() const { return bodies_.size() == columns_; }  ///< hangs on nothing
    bool isSoft() const { return isSoft_; }  ///< whether the step took what loses energy or gives way

private:
    struct BranchRows;

    struct Rates {
        double turn = 0;   ///< rad/s
        double phase = 0;  ///< rad/s
    };

    /// How a step is divided where its rows are exact.
    struct ExactWay {
        double h = 0;  ///< s, of a sub-step
        int subSteps = 0;
        int finer = 1;         ///< times as many as the motion asks for
        bool isStiff = false;  ///< a tree whose rows are placed anew in each sub-step (joint_island_middle.cpp)
    };

    /// Of the gaps that a step began with, what is not yet to be closed.
    double openPart() const { return keepsOpen_ ? 1 : 1 - elapsed_ / duration_; }
    /// Rods are as long as they are to be when the sub-step ends.
    void goOn(double time) {
        elapsed_ += time;
        if (isPaced_) { moveRods(); }
    }
    void goBack() {
        elapsed_ = 0;
        if (isPaced_) { moveRods(); }
    }

    // joint_island.cpp
    Rates ratesOf(double h);
    bool mayFlow(double duration, const Rates& rates) const;
    bool advanceSmoothly(double h, int subSteps, JointFlow& flow);
    bool advanceExactly(double h, int subSteps, int finer, const Rates& rates);
    double mostCompositions() const;
    bool subStepExactly(const ExactWay& way, double part, double length);
    bool subStepEvenly(const ExactWay& way, const Rates& rates);
    bool subStepByCompositions(const ExactWay& way, const Rates& rates);
    void advanceAnyhow(double h, int subSteps, const Rates& rates);
    bool advanceByEnds(double h, int subSteps, int more);
    void advanceSoftly(double h, int subSteps, const Rates& rates);
    bool hasAccount() const;
    double mostLead() const;
    void bringTo(double energy, double mostGrowth);
    double fallOf(double h) const;
    bool keepsEnergy(double h, int subSteps, double begun);
    bool subStep(double part, double h);
    void subStepSoftly(double h);
    void drive(double part);
    void halveDrives();
    void pushForces(double time);
    bool reachPlaces(double time);
    bool hold();
    void arrive();
    void dropForces();
    void dropTotals();
    void endStage();

    // joint_island_rows.cpp
    bool isOpen() const;
    void moveRods();
    void weigh();
    void push(const IslandHold& hold, const IslandHold::Row& row, double impulse);
    void findPlaces(double time);
    void findOpenGaps();
    double findGaps(double time);
    double findSpeeds();
    void addGapSpeeds();
    void correct(bool keep);
    void placeRows();
    void factorise();

    // joint_island_middle.cpp
    enum class ForceAt : std::uint8_t { middle, end };  ///< of a sub-step
    bool subStepByMiddle(double part, double h) { return subStepOfTree(part, h, ForceAt::middle, false); }
    bool subStepOfTree(double part, double h, ForceAt at, bool isLast);
    void holdTree();
    void closeGaps();
    void findTreePlaces(double time);
    void placeTreeRows(double time, ForceAt at);
    double findTreeGaps(double time);
    double findMomenta();
    double worstLack() const;
    void leaveSubStep(double time, ForceAt at);

    // joint_island_tree.cpp
    void growTree();
    void gatherBranch(const IslandBranch& branch, BranchRows& rows) const;
    double leastResponse(const Block3& pushes, const Block3& moves, const IslandBranch& branch) const;
    void factoriseTree();
    void solveTree(double time);
    void applyChanges(double part);

    std::vector<IslandBody> bodies_;
    std::vector<IslandHold> holds_;
    std::vector<IslandDrive> drives_;
    std::vector<IslandBody> start_;
    std::vector<IslandHold> saved_;  ///< while gaps are closed
    std::vector<BlockEdge> edges_;
    std::vector<Block3> change_;
    std::vector<double> tensions_;  ///< square of the rate at which a body would oscillate, by body
    BlockLdlt matrix_;
    std::vector<IslandBranch> branches_;  ///< from the ground, or from one of the bodies, outwards
    std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;  ///< bodies and their holds; scratch
    std::vector<char> isReached_;                                      ///< by body; scratch
    std::vector<Block33> inertias_;                                    ///< by body; factorised
    double duration_ = 0;                                              ///< of the step, s
    double elapsed_ = 0;                                               ///< of it
    std::uint32_t columns_ = 0;
    int factorisations_ = 0;
    int subSteps_ = 0;
    bool isTree_ = false;
    bool keepsOpen_ = false;  ///< whether the gaps that a step began with stay as wide as they were
    bool isSoft_ = false;
    bool isPaced_ = false;
    bool isUndone_ = false;
    double woundSpeed_ = 0;  ///< 0: no hold does work
};

}  // namespace swept::inline SWEPT_PRECISION
