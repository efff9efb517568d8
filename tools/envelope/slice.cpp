#include "slice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swept::envelope {

std::vector<Slice> allSlices(Grain grain) {
    return {stackSlice(grain), wallSlice(grain), chainSlice(grain), bulletSlice(grain), restSlice(grain)};
}

std::vector<double> powers(double base, double first, double last, double step) {
    std::vector<double> values;
    const auto count = static_cast<int>(std::floor((last - first) / step + 0.5)) + 1;
    for (int i = 0; i < count; ++i) { values.push_back(std::pow(base, first + i * step)); }
    return values;
}

std::function<double(const Frame&)> farthestMove(const SceneDescription& scene, double size) {
    std::vector<std::pair<std::size_t, DVec2>> starts;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].type == SceneBodyType::dynamic) { starts.emplace_back(i, scene.bodies[i].position); }
    }
    return [starts, size](const Frame& frame) {
        double farthest = 0;
        for (const auto& [body, start] : starts) {
            farthest = std::max(farthest, length(frame.bodies[body].position - start));
        }
        return farthest / size;
    };
}

}  // namespace swept::envelope
