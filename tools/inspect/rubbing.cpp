#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "placed_scene.h"

namespace swept {
namespace {

/// Pieces of the same filter and rule, all with friction or all without, of dynamic bodies or of others, in the order
/// of the scene.
struct Likes {
    const ShapeDescription* shape = nullptr;  ///< of the first
    FullSurface surface;                      ///< likewise
    std::vector<int> pieces;
};

/// Scenes have few different filters and rules, however many pieces.
std::vector<Likes> likesOf(const PlacedScene& placed) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::int32_t, MixingRule, bool>, std::size_t> places;
    std::vector<Likes> likes;
    for (std::size_t i = 0; i < placed.pieces.size(); ++i) {
        const ShapeDescription& shape = shapeOf(placed, placed.pieces[i]);
        if (shape.sensor) { continue; }
        const FilterDescription& filter = shape.filter;
        const FullSurface surface = surfaceOf(placed, placed.pieces[i]);
        const std::tuple kind(filter.category, filter.mask, filter.group, surface.frictionMixing, rubs(surface));
        const auto [place, isNew] = places.emplace(kind, likes.size());
        if (isNew) { likes.push_back({&shape, surface, {}}); }
        likes[place->second].pieces.push_back(static_cast<int>(i));
    }
    return likes;
}

}  // namespace

RubbingBodies firstRubbing(const PlacedScene& placed) {
    const std::set<std::pair<int, int>> jointed = jointedPairs(placed);
    const std::vector<Likes> likes = likesOf(placed);
    const auto pieceAt = [&](int i) -> const PlacedPiece& { return placed.pieces[static_cast<std::size_t>(i)]; };
    for (const PlacedPiece& a : placed.pieces) {
        const ShapeDescription& shape = shapeOf(placed, a);
        if (!bodyOf(placed, a).isDynamic() || shape.sensor) { continue; }
        const FullSurface surface = surfaceOf(placed, a);
        int first = static_cast<int>(placed.pieces.size());
        for (const Likes& others : likes) {
            if (!filtersCollide(shape.filter, others.shape->filter)) { continue; }
            if (!(mixedFriction(surface, others.surface) > 0)) { continue; }
            // All pieces of a body follow each other: those of one that is no partner are passed over at once.
            for (auto b = others.pieces.begin(); b != others.pieces.end() && *b < first;) {
                const int body = pieceAt(*b).body;
                if (body != a.body && !jointed.contains({std::min(a.body, body), std::max(a.body, body)})) {
                    first = *b;
                    break;
                }
                b = std::partition_point(b, others.pieces.end(), [&](int i) { return pieceAt(i).body <= body; });
            }
        }
        if (first < static_cast<int>(placed.pieces.size())) { return {a.body, pieceAt(first).body}; }
    }
    return {};
}

}  // namespace swept
