#include <swept/broadphase/broadphase.h>

#include <cstdio>
#include <vector>

/// Puts two boxes into a broadphase and asks for the pair.
int main() {
    const auto broadphase = swept::makeBroadphase(swept::BroadphaseKind::bvh);
    const auto floor = broadphase->insert({{-10, -1}, {10, 0}}, swept::ProxyKind::fixed);
    const auto ball = broadphase->insert({{-1, 0}, {1, 2}}, swept::ProxyKind::dynamic);
    std::vector<swept::ProxyPair> pairs;
    broadphase->pairs(pairs);
    std::printf("%zu pair, sizeof(Real) = %zu\n", pairs.size(), sizeof(swept::Real));
    return floor.ok() && ball.ok() && pairs.size() == 1 ? 0 : 1;
}
