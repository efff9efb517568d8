#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "placed_scene.h"

namespace swept {
namespace {

/// Pieces with friction whose filters are the same, of dynamic bodies or of others, in the order of the scene.
struct Likes {
    FilterDescription filter;
    std::vector<int> pieces;
};

bool rubs(const PlacedScene& placed, const PlacedPiece& piece) {
    const ShapeDescription& shape = shapeOf(placed, piece);
    return shape.friction > 0 && !shape.sensor;
}

/// Scenes have few different filters, however many pieces.
std::vector<Likes> likesOf(const PlacedScene& placed) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::int32_t>, std::size_t> places;
    std::vector<Likes> likes;
    for (std::size_t i = 0; i < placed.pieces.size(); ++i) {
        if (!rubs(placed, placed.pieces[i])) { continue; }
        const FilterDescription& filter = shapeOf(placed, placed.pieces[i]).filter;
        const auto [place, isNew] =
            places.emplace(std::tuple(filter.category, filter.mask, filter.group), likes.size());
        if (isNew) { likes.push_back({filter, {}}); }
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
        if (!bodyOf(placed, a).isDynamic() || !rubs(placed, a)) { continue; }
        int first = static_cast<int>(placed.pieces.size());
        for (const Likes& others : likes) {
            if (!filtersCollide(shapeOf(placed, a).filter, others.filter)) { continue; }
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
