#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/dvec2.h"
#include "island_drive.h"
#include "joint_island_parts.h"

namespace swept::inline SWEPT_PRECISION {

/// Bodies on rigid joints that close no loop, taken through a step as a differential equation.
///
/// Accelerations that agree with all joints are found in one go: from the leaves to the ground each body is eliminated
/// by what its joint leaves free, and adds to the next one what it weighs there (Featherstone 1983, "The calculation of
/// robot dynamics using articulated-body inertias"); then they are known from the ground to the leaves. So there is
/// nothing to be iterated, and an explicit method of the eighth order (Cooper & Verner 1972) takes eleven of these
/// where others solve for impulses several times in each of ten sub-steps. Gaps are left with rounding by then, and
/// are closed by moving bodies as little as can be for their masses.
///
/// The step is divided into pieces by how fast bodies turn and light links oscillate; one over which accelerations
/// turn out not to be smooth is made anew, half as long. So it need not be symmetric in time to keep energy: a rope of
/// twenty links that is let go level, and cracks, is off by 4e-7 of it after five seconds in float, by 2e-9 in double.
///
/// Springs are forces among the others, and so are motors that push as hard as they may; what a motor holds at its
/// speed is one way less to move. That is smooth as long as no limit is reached, and no motor ends to push, or to hold:
/// where one does, the step is another's to take.
class JointFlow {
public:
    /// Whether it can be taken through a step so: it moves and turns, and is damped by no more than pieces follow.
    static bool mayTake(const IslandBody& body);
    /// So that islands of so many bodies ask for no memory.
    void reserve(std::size_t bodies) {
        nodes_.reserve(bodies);
        nodeOf_.reserve(bodies);
        tensions_.reserve(bodies);
        drives_.reserve(2 * bodies);
    }
    /// What moves, and how.
    struct Island {
        std::span<const IslandBody> bodies;
        std::span<const IslandHold> holds;
        std::span<const IslandBranch> branches;
        std::span<const IslandDrive> drives;
    };
    /// @pre it may take the bodies that the island moves
    /// @param h  of the sub-step that the drives of bodies were made for
    void start(const Island& island, double h);
    /// What light links under tension do, which oscillate.
    enum class Tremor : std::uint8_t {
        followed,
        unseen,  ///< all hangs still: it only has to die away
    };
    /// @param most  pieces that the time may be divided into
    /// @return false where they do not do, joints cannot be brought together, or a drive is not what it was all the
    /// time
    bool advance(double duration, double most, Tremor tremor);
    void finish(std::span<IslandBody> bodies, std::span<IslandHold> holds, std::span<IslandDrive> drives) const;

    int evaluations() const { return evaluations_; }  ///< of the accelerations
    int pieces() const { return pieces_; }
    double begun() const { return begun_; }  ///< kinetic energy of the speeds that joints allow, at the start, J

    /// Of a body, or what acts along them. (Loops over three numbers take longer than all that is done with them.)
    struct Coordinates {
        double x = 0;
        double y = 0;
        double turn = 0;

        constexpr DVec2 linear() const { return {x, y}; }

        constexpr bool operator==(const Coordinates&) const = default;
        constexpr Coordinates& operator+=(const Coordinates& v) { return *this = *this + v; }
        constexpr Coordinates& operator-=(const Coordinates& v) { return *this = *this - v; }
        friend constexpr Coordinates operator+(const Coordinates& a, const Coordinates& b) {
            return {a.x + b.x, a.y + b.y, a.turn + b.turn};
        }
        friend constexpr Coordinates operator-(const Coordinates& a, const Coordinates& b) {
            return {a.x - b.x, a.y - b.y, a.turn - b.turn};
        }
        friend constexpr Coordinates operator*(double s, const Coordinates& v) {
            return {s * v.x, s * v.y, s * v.turn};
        }
        /// A turn about the point at this arm.
        static constexpr Coordinates turnAbout(DVec2 arm) { return {arm.y, -arm.x, 1}; }
        /// How a force on this acts on what leads it, from which it is a span away.
        constexpr Coordinates moved(DVec2 span) const { return {x, y, turn + (span.x * y - span.y * x)}; }
    };
    /// Symmetric.
    struct Inertia {
        double xx = 0;
        double yx = 0;
        double yy = 0;
        double tx = 0;
        double ty = 0;
        double tt = 0;
    };

private:
    static constexpr std::size_t kStages = 11;
    static constexpr std::uint32_t kNone = IslandBranch::kNone;

    /// A way in which a body may move beside the one nearer to the ground.
    struct Freedom {
        Coordinates along{};
        Coordinates pushed{};  ///< forces that accelerate it by that
        Coordinates ease{};    ///< how it yields along it to accelerations of the parent, without a sign
        double gain = 0;       ///< acceleration along it, if the parent had none
    };
    /// A body, and its joint to the one nearer to the ground.
    struct Node {
        std::uint32_t body = 0;
        std::uint32_t parent = kNone;
        std::uint32_t hold = kNone;
        std::uint32_t angleHold = kNone;
        IslandHold::Kind kind = IslandHold::Kind::point;
        bool isB = false;         ///< of the joint
        bool isFixed = false;     ///< or moved, and not by the island
        bool isStill = false;     ///< fixed
        bool isPin = false;       ///< it may turn about a point, and nothing else
        bool isLever = false;     ///< its turn moves an anchor, or an axis
        bool holdsTurn = false;   ///< a motor does
        bool holdsSlide = false;  ///< likewise
        std::uint32_t freedoms = 0;
        double mass = 0;
        double inertia = 0;
        Coordinates drive{};  ///< m/s², rad/s²
        double damping = 0;   ///< 1/s
        double angularDamping = 0;
        DVec2 anchor;  ///< at the start of the step
        DVec2 anchorOfParent;
        DVec2 offset;  ///< from the parent's centre
        DVec2 axis;
        double rest = 0;
        double restAngle = 0;
        double size = 0;
        double reach = 0;  ///< by which what swings on a rod, or slides, is taken for a turn, metres
        double ease = 0;   ///< with which forces of the joint turn it, rad/(kg·m)
        double easeOfParent = 0;

        Coordinates startPlace{};  ///< x, y, angle, since the start of the step
        Coordinates startVelocity{};
        std::array<Coordinates, kStages> accelerations{};

        Coordinates place{};
        Coordinates velocity{};
        double c = 1;
        double s = 0;
        DVec2 armOfJoint;    ///< from the centre to where the joint's force acts
        DVec2 armOfParent;   ///< likewise, of a pin
        DVec2 direction;     ///< of a rod, away from the parent; of the axis of what slides
        Coordinates bias{};  ///< acceleration, or change, beside the parent's and what is free

        Freedom free[3];
        Inertia carried;        ///< with all that hangs on it
        Coordinates force{};    ///< likewise
        Coordinates reached{};  ///< acceleration, or change

        /// By the joint, since the start of the step.
        struct Given {
            DVec2 impulse;
            double twist = 0;
            double along = 0;  ///< of the impulse, along the direction of what holds it
        };
        Given total;
        Given given;  ///< likewise, with what of a piece is done
    };

    /// Of a joint, where its bodies are now.
    struct Arms {
        DVec2 own;
        DVec2 ofParent;
        DVec2 between;  ///< from the parent's anchor to the own one
    };

    /// Along what the joint of a node leaves free.
    struct Drive {
        IslandDrive is;
        std::uint32_t number = 0;  ///< of the island
        std::uint32_t node = 0;
        double sign = 1;      ///< of the node's motion against its parent in that of B against A
        double pull = 0;      ///< of the spring, as the last evaluation found it
        double ofMotor = 0;   ///< impulse since the start of the step, with what of a piece is done
        double ofSpring = 0;  ///< likewise
    };
    struct DriveMotion {
        double place = 0;
        double speed = 0;
    };

    // joint_flow.cpp: accelerations
    Node& addNode(const Island& island, std::uint32_t i);
    static void setDrive(Node& node, const IslandBody& body, double h);
    void hang(Node& node, const Island& island);
    static void turn(Node& node);
    static DVec2 spanOf(const Node& node, const Node& parent);
    static Arms armsOf(const Node& node, const Node& parent);
    static DVec2 speedAt(const Arms& arms, const Node& node, const Node& parent);
    void placeJoints();
    static void setPoint(Node& node, const Node& parent);
    static void setRod(Node& node, const Node& parent);
    static void setSide(Node& node, const Node& parent);
    void loadDrives();
    void solve();
    void eliminate(Node& node);
    void eliminatePin(Node& node);
    void reach(Node& node) const;
    void reachByPin(Node& node) const;
    static Coordinates pushOn(const Node& node);
    void accelerate(std::size_t stage);

    // joint_flow_drives.cpp: along what joints leave free
    void addDrives(Node& node, const Island& island);
    DriveMotion motionOf(const Drive& drive) const;
    static Coordinates directionOf(const Drive& drive, const Node& node);
    void pullSprings();
    void addPushes(double time);
    void addHeld(double time);
    double fastestSpring() const;
    void wantSpeeds();
    bool areDrivesSame();
    bool areWithinStrength(double time) const;

    // joint_flow_steps.cpp: how they are gone through
    double rate(double mostPhase);
    template <std::size_t kStage>
    void moveTo(double time);
    void step(double time);
    void addImpulses(double time);
    double bend(double time) const;
    void accept(double time);
    void begin();
    void agree();
    bool settle();
    double closeGaps();

    std::vector<Node> nodes_;            ///< what cannot be moved, then branches from the ground outwards
    std::vector<Drive> drives_;          ///< by node
    std::vector<std::uint32_t> nodeOf_;  ///< by body
    std::size_t fixed_ = 0;              ///< nodes
    std::vector<double> tensions_;       ///< by node; scratch
    int evaluations_ = 0;
    int pieces_ = 0;
    double begun_ = 0;
};

}  // namespace swept::inline SWEPT_PRECISION
