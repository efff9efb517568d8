#pragma once

#include <memory>
#include <string>
#include <vector>

#include <swept/shapes/dvec2.h>

/// Crowds of equal disks and squares among walls without thickness, which every engine with a world can play.

namespace swept::bench {

inline constexpr double kCrowdRadius = 0.1;  ///< of a disk, and half the side of a square, metres
inline constexpr double kCrowdDensity = 1;   ///< kg/m²
inline constexpr double kCrowdFriction = 0.3;

struct CrowdWall {
    DVec2 p;
    DVec2 q;
};

struct CrowdBody {
    bool isDisk = true;
    DVec2 place{};
    double angle = 0;
    DVec2 velocity{};
    double spin = 0;  ///< rad/s
};

/// Without gravity, friction `kCrowdFriction`, no sleep; 60 Hz, continuous collision on.
struct Crowd {
    std::string name;
    std::vector<CrowdWall> walls{};
    std::vector<CrowdBody> bodies{};
    double restitution = 1;
    bool bodiesMeet = true;  ///< else they collide with walls alone
    double half = 0;         ///< of the square that no body should leave, metres
};

/// An engine that plays a crowd.
class CrowdEngine {
public:
    virtual ~CrowdEngine() = default;
    virtual std::string name() const = 0;
    /// Anew, with its own default accuracy.
    virtual void begin(const Crowd& crowd) = 0;
    virtual void step() = 0;
    /// Place, velocity and spin of every body now; angle and kind may be left out.
    virtual std::vector<CrowdBody> bodies() const = 0;
    /// Seconds that bodies lost so far, summed over them; negative: the engine does not tell.
    virtual double lostSeconds() const { return -1; }
};

/// What the bodies of a crowd are swept against in this engine.
enum class CrowdSweeps { nothing, walls, everything };

std::unique_ptr<CrowdEngine> makeSweptCrowd(CrowdSweeps sweeps);
std::unique_ptr<CrowdEngine> makeBox2dCrowd();

}  // namespace swept::bench
