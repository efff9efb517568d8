#pragma once

#include <swept/broadphase/broadphase.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "../support/random.h"

namespace swept::test {

/// Every implementation by itself; `automatic` is one of them.
inline constexpr BroadphaseKind kEveryKind[] = {BroadphaseKind::allPairs, BroadphaseKind::sortAndSweep,
                                                BroadphaseKind::quadtree, BroadphaseKind::grid,
                                                BroadphaseKind::bvh,      BroadphaseKind::wideBvh};

inline std::string nameOf(BroadphaseKind kind) {
    switch (kind) {
        case BroadphaseKind::automatic:
            return "automatic";
        case BroadphaseKind::allPairs:
            return "allPairs";
        case BroadphaseKind::sortAndSweep:
            return "sortAndSweep";
        case BroadphaseKind::quadtree:
            return "quadtree";
        case BroadphaseKind::grid:
            return "grid";
        case BroadphaseKind::bvh:
            return "bvh";
        case BroadphaseKind::wideBvh:
            return "wideBvh";
    }
    return "";
}
inline std::ostream& operator<<(std::ostream& out, BroadphaseKind kind) { return out << nameOf(kind); }

/// 0 … count − 1; `count` > 0.
inline std::uint32_t below(Random& random, std::uint32_t count) {
    return static_cast<std::uint32_t>(random.integer(0, static_cast<int>(count) - 1));
}

/// What a broadphase promises, in the plainest words: a map of boxes.
class Model {
public:
    struct Proxy {
        Aabb box;
        ProxyKind kind = ProxyKind::fixed;
        std::optional<Aabb> known = std::nullopt;  ///< the box when pairs were asked for last
    };

    std::uint32_t insert(const Aabb& box, ProxyKind kind) {
        std::uint32_t slot = 0;
        while (proxies_.count(slot) != 0) { ++slot; }
        proxies_[slot] = {box, kind};
        return slot;
    }
    void move(std::uint32_t slot, const Aabb& box) { proxies_[slot].box = box; }
    void renew(std::uint32_t slot) { proxies_[slot].known.reset(); }
    void remove(std::uint32_t slot) { proxies_.erase(slot); }
    std::vector<ProxyPair> pairs() {
        std::vector<ProxyPair> found;
        for (const auto& [a, proxyA] : proxies_) {
            for (const auto& [b, proxyB] : proxies_) {
                if (a >= b || !mayMeet(proxyA.kind, proxyB.kind) || !touching(proxyA.box, proxyB.box)) { continue; }
                if (proxyA.known && proxyB.known && touching(*proxyA.known, *proxyB.known)) { continue; }
                found.push_back({static_cast<ProxyId>(a), static_cast<ProxyId>(b)});
            }
        }
        for (auto& [slot, proxy] : proxies_) { proxy.known = proxy.box; }
        return found;
    }
    std::set<std::uint32_t> overlapping(const Aabb& box) const {
        std::set<std::uint32_t> found;
        for (const auto& [slot, proxy] : proxies_) {
            if (touching(box, proxy.box)) { found.insert(slot); }
        }
        return found;
    }
    const std::map<std::uint32_t, Proxy>& proxies() const { return proxies_; }

private:
    static bool touching(const Aabb& a, const Aabb& b) {
        return std::max(a.lower.x, b.lower.x) <= std::min(a.upper.x, b.upper.x) &&
               std::max(a.lower.y, b.lower.y) <= std::min(a.upper.y, b.upper.y);
    }
    /// Who meets whom, spelled out: fixed, kinematic, dynamic, sensor.
    static bool mayMeet(ProxyKind a, ProxyKind b) {
        static constexpr bool kTable[4][4] = {{false, false, true, true},
                                              {false, false, true, true},
                                              {true, true, true, true},
                                              {true, true, true, false}};
        return kTable[static_cast<int>(a)][static_cast<int>(b)];
    }

    std::map<std::uint32_t, Proxy> proxies_;
};

/// Families of boxes that between them reach what is hard: sizes 1 : 10⁶, one place, long and thin, touching, far away.
enum class Family { scattered, mixedSizes, onePlace, longThin, touchingGrid, wideWorld, nested };
inline constexpr Family kFamilies[] = {Family::scattered,    Family::mixedSizes, Family::onePlace, Family::longThin,
                                       Family::touchingGrid, Family::wideWorld,  Family::nested};

inline std::string nameOf(Family family) {
    switch (family) {
        case Family::scattered:
            return "scattered";
        case Family::mixedSizes:
            return "mixedSizes";
        case Family::onePlace:
            return "onePlace";
        case Family::longThin:
            return "longThin";
        case Family::touchingGrid:
            return "touchingGrid";
        case Family::wideWorld:
            return "wideWorld";
        case Family::nested:
            return "nested";
    }
    return "";
}
inline std::ostream& operator<<(std::ostream& out, Family family) { return out << nameOf(family); }

inline Aabb boxAround(double x, double y, double halfWidth, double halfHeight) {
    return roundedOutward({x - halfWidth, y - halfHeight}, {x + halfWidth, y + halfHeight});
}

inline Aabb randomBox(Family family, Random& random) {
    const double x = random.range(-20, 20);
    const double y = random.range(-20, 20);
    switch (family) {
        case Family::scattered:
            return boxAround(x, y, random.range(0.2, 2), random.range(0.2, 2));
        case Family::mixedSizes: {
            const double half = 10 * std::ldexp(1.0, -static_cast<int>(below(random, 21)));
            return boxAround(x, y, half, half * random.range(0.5, 2));
        }
        case Family::onePlace:
            return boxAround(1, 2, 0.5, 0.5);
        case Family::longThin:
            return random.chance(0.5) ? boxAround(x, y, random.range(5, 30), 0.001)
                                      : boxAround(x, y, 0.001, random.range(5, 30));
        case Family::touchingGrid: {
            const auto column = static_cast<Real>(below(random, 12));
            const auto row = static_cast<Real>(below(random, 12));
            return {{column, row}, {column + 1, row + 1}};
        }
        case Family::wideWorld: {
            const double scale = random.chance(0.5) ? 5e4 : 1;
            const double half = random.range(0.2, 2) * scale;
            return boxAround(x * scale, y * scale, half, half);
        }
        case Family::nested: {
            const double half = std::ldexp(1.0, static_cast<int>(below(random, 40)) - 20);
            return boxAround(0, 0, half, half);
        }
    }
    return {};
}

inline ProxyKind randomKind(Random& random) { return static_cast<ProxyKind>(below(random, kProxyKindCount)); }

/// A box near `box`, as a proxy moves in a step or two.
inline Aabb shifted(const Aabb& box, Random& random) {
    const double width = static_cast<double>(box.upper.x) - static_cast<double>(box.lower.x);
    const double height = static_cast<double>(box.upper.y) - static_cast<double>(box.lower.y);
    const DVec2 by = {width * random.range(-0.5, 0.5), height * random.range(-0.5, 0.5)};
    const DVec2 lower = toDouble(box.lower);
    const DVec2 upper = toDouble(box.upper);
    return roundedOutward({lower.x + by.x, lower.y + by.y}, {upper.x + by.x, upper.y + by.y});
}

}  // namespace swept::test
