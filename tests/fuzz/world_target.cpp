#include <optional>
#include <vector>

#include <swept/engine/world.h>

#include "../engine/world_digest.h"
#include "fuzz_targets.h"

namespace swept::test {
namespace {

constexpr std::uint32_t kMostBodies = 8;
constexpr int kMostSteps = 24;
constexpr double kStep = 1.0 / 60;

/// Reads calls from the bytes and makes them.
class Program {
public:
    explicit Program(Bytes bytes) : input_(bytes) {}

    void run() {
        while (!input_.isOver() && steps_ < kMostSteps) {
            const std::uint64_t before = digestOf(world_, known_);
            const Status status = call();
            if (status.ok()) {
                demandFinite();
            } else {
                demand(status.field[0] != '\0', "a refusal names what is wrong");
                demand(digestOf(world_, known_) == before, "what is refused changes nothing");
            }
        }
    }

private:
    Real real() { return static_cast<Real>(input_.number()); }
    Vec2 vector() {
        const Real x = real();
        return {x, real()};
    }
    DVec2 place() {
        const double x = input_.number();
        return {x, input_.number()};
    }
    template <class Id>
    Id pick(const std::vector<Id>& ids) {
        const std::uint8_t choice = input_.byte();
        return ids.empty() ? Id{} : ids[choice % ids.size()];
    }
    template <class Id>
    static Status keep(const Result<Id>& id, std::vector<Id>& ids) {
        if (id.ok()) { ids.push_back(id.value()); }
        return id.status();
    }

    Status call() {
        switch (input_.below(13)) {
            case 0:
                return makeBody();
            case 1:
                return addShape();
            case 2:
                return addChain();
            case 3:
                return makeJoint();
            case 4:
                return push();
            case 5:
                return world_.setPose(pick(known_.bodies), place(), input_.number());
            case 6:
                return world_.destroyBody(pick(known_.bodies));
            case 7:
                return world_.destroyShape(pick(known_.shapes));
            case 8:
                return world_.destroyJoint(pick(known_.joints));
            case 9:
                return configure();
            case 10:
                return ask();
            case 12:
                return changeJoint();
            default:
                ++steps_;
                return world_.step(input_.flag() ? kStep : input_.number());
        }
    }

    Status makeBody() {
        if (world_.bodyCount() >= kMostBodies) { return Status::success(); }
        BodyDef def;
        def.type = static_cast<BodyType>(input_.below(4));
        def.position = place();
        def.velocity = vector();
        def.angularVelocity = real();
        if (input_.flag()) { def.mass = real(); }
        def.bullet = input_.flag();
        const Result<BodyId> id = world_.createBody(def);
        if (!id.ok()) { return id.status(); }
        known_.bodies.push_back(id.value());
        const Result<Polygon> disk = makeCircle({}, Real(0.5));
        if (input_.flag()) { (void)world_.addShape(id.value(), disk.value()); }
        return id.status();
    }
    Status addShape() {
        const BodyId body = pick(known_.bodies);
        Polygon polygon;
        polygon.count = input_.below(10);
        polygon.radius = real();
        for (int i = 0; i < polygon.count && i < kMaxPolygonVertices; ++i) {
            polygon.vertices[static_cast<std::size_t>(i)] = vector();
        }
        const Result<Polygon> made = input_.flag()
                                         ? makePolygon(polygon.points().first(static_cast<std::size_t>(
                                                           polygon.count < kMaxPolygonVertices ? polygon.count : 8)),
                                                       polygon.radius)
                                         : box();
        ShapeDef def{.density = real(), .friction = real(), .restitution = real(), .surfaceSpeed = real()};
        def.sensor = input_.flag();
        return keep(world_.addShape(body, made.ok() ? made.value() : polygon, def), known_.shapes);
    }
    Result<Polygon> box() {
        const Vec2 half = vector();
        const Vec2 center = vector();
        return makeBox(half, center, input_.number());
    }
    Status addChain() {
        std::vector<Vec2> points(static_cast<std::size_t>(input_.below(6)));
        for (Vec2& p : points) { p = vector(); }
        const BodyId body = pick(known_.bodies);
        return keep(world_.addChain(body, points, input_.flag()), known_.shapes);
    }
    template <class Make>
    auto maybe(Make&& make) -> std::optional<decltype(make())> {
        return input_.flag() ? std::optional(make()) : std::nullopt;
    }
    template <class Pair>
    std::optional<Pair> maybePair() {
        return maybe([&] {
            const Real first = real();
            return Pair{first, real()};
        });
    }
    template <class Def>
    Status join(const Def& def) {
        return keep(world_.createJoint(def), known_.joints);
    }
    Status makeJoint() {
        JointDef base{.bodyA = pick(known_.bodies), .bodyB = pick(known_.bodies)};
        base.collideConnected = input_.flag();
        base.breakForce = maybe([&] { return real(); });
        switch (static_cast<JointType>(input_.below(static_cast<int>(JointType::filter) + 1))) {
            case JointType::revolute:
                return join(RevoluteJointDef{.base = base, .anchor = place()});
            case JointType::distance:
                return join(DistanceJointDef{.base = base, .anchorA = place(), .anchorB = place()});
            case JointType::prismatic:
                return join(PrismaticJointDef{.base = base, .anchor = place(), .axis = place()});
            case JointType::wheel:
                return join(WheelJointDef{.base = base, .anchor = place(), .axis = place()});
            case JointType::weld:
                return join(WeldJointDef{.base = base, .anchor = place()});
            case JointType::motor:
                return join(MotorJointDef{.base = base, .drive = drive()});
            case JointType::mouse:
                return join(MouseJointDef{.base = base, .target = place()});
            case JointType::gear:
                return join(
                    GearJointDef{.jointA = pick(known_.joints), .jointB = pick(known_.joints), .ratio = real()});
            case JointType::pulley:
                return join(PulleyJointDef{.base = base,
                                           .groundA = place(),
                                           .groundB = place(),
                                           .anchorA = place(),
                                           .anchorB = place(),
                                           .ratio = real()});
            case JointType::filter:
                return join(FilterJointDef{.base = base});
        }
        return Status::success();
    }
    MotorDrive drive() {
        MotorDrive drive;
        drive.linearOffset = maybe([&] { return vector(); });
        drive.linearVelocity = maybe([&] { return vector(); });
        drive.angularVelocity = maybe([&] { return real(); });
        drive.maxForce = maybe([&] { return real(); });
        drive.maxTorque = maybe([&] { return real(); });
        return drive;
    }
    Status changeJoint() {
        const JointId joint = pick(known_.joints);
        switch (input_.below(10)) {
            case 0:
                return world_.setAngularMotor(joint, maybePair<AngularMotor>());
            case 1:
                return world_.setLinearMotor(joint, maybePair<LinearMotor>());
            case 2:
                return world_.setAngleLimits(joint, maybePair<AngleLimits>());
            case 3:
                return world_.setTranslationLimits(joint, maybePair<TranslationLimits>());
            case 4:
                return world_.setLengthLimits(joint, maybePair<LengthLimits>());
            case 5:
                return world_.setLength(joint, real());
            case 6:
                return world_.setSpring(joint, maybePair<Spring>());
            case 7:
                return world_.setWeldSprings(joint, maybePair<Spring>(), maybePair<Spring>());
            case 8:
                return world_.setTarget(joint, place());
            default:
                return world_.setDrive(joint, drive());
        }
    }
    Status push() {
        const BodyId body = pick(known_.bodies);
        const int how = input_.below(4);
        if (how == 3) { return world_.setAwake(body, input_.flag()); }
        const Vec2 amount = vector();
        switch (how) {
            case 0:
                return world_.setVelocity(body, amount, real());
            case 1:
                return world_.applyForce(body, amount, place());
            default:
                return world_.applyImpulse(body, amount, place());
        }
    }
    Status configure() {
        WorldSettings settings;
        settings.gravity = vector();
        if (const int subSteps = input_.below(16); subSteps > 0) { settings.subSteps = subSteps; }
        settings.continuous = static_cast<ContinuousMode>(input_.below(6));
        settings.broadphase = static_cast<BroadphaseKind>(input_.below(kBroadphaseKindCount + 1));
        settings.maxImpacts = input_.below(20) - 1;
        if (input_.flag()) { settings.maxSpeed = real(); }
        return world_.configure(settings);
    }
    Status ask() {
        const DVec2 from = place();
        (void)world_.castRay(from, vector());
        world_.queryBox({vector(), vector()}, {}, [this](ShapeId shape) {
            if (input_.flag()) { (void)world_.destroyBody(world_.bodyOf(shape)); }
            return true;
        });
        return Status::success();
    }

    void demandFinite() const {
        for (const BodyId id : known_.bodies) {
            demand(isFinite(world_.position(id)) && std::isfinite(world_.angle(id)) && isFinite(world_.velocity(id)) &&
                       std::isfinite(world_.angularVelocity(id)),
                   "states stay finite");
        }
        for (const JointId id : known_.joints) {
            demand(isFinite(world_.jointForce(id)) && std::isfinite(world_.jointTorque(id)) &&
                       !std::isnan(world_.jointError(id)),
                   "reactions stay finite");
        }
    }

    FuzzInput input_;
    World world_;
    KnownIds known_;
    int steps_ = 0;
};

}  // namespace

void fuzzWorld(Bytes bytes) { Program(bytes).run(); }

}  // namespace swept::test
