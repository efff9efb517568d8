#pragma once

#include <numbers>

#include "../../samples/scene_builder.h"
#include "toi_query.h"

/// What the families of queries are put together from.

namespace swept::cases {

using build::Dice;

inline constexpr double kTurn = 2 * std::numbers::pi;

bool chance(Dice& dice, double probability);
/// From low to high, both included.
int integer(Dice& dice, int low, int high);
/// Every order of magnitude equally likely; 0 < low < high.
double logRange(Dice& dice, double low, double high);
double sign(Dice& dice);
DVec2 direction(Dice& dice);

/// A convex polygon of `low` … `high` vertices on an ellipse with half-axes size and size · aspect, off the origin of
/// its frame; with a radius in four of ten cases, and always when it is a single point.
ToiPolygon randomPolygon(Dice& dice, double size, double aspect = 1, int low = 1, int high = 8);
ToiPolygon circle(double radius);
ToiPolygon box(DVec2 center, DVec2 half);
/// One corner replaced by an edge of about `ratio` of the sides beside it. For three to seven vertices.
ToiPolygon withCutCorner(Dice& dice, ToiPolygon polygon, double ratio);

struct Approach {
    double distance = 2;       ///< of the centres at the start, in the sum of the sizes
    double travel = 3;         ///< largest, in the same
    double miss = 0.7;         ///< largest distance from A's centre of the point that B heads for, in the same
    double turns = 0.125;      ///< largest of either body; none in a fifth of the bodies
    double acceleration = 0;   ///< largest |k|, in the body's size
    double localCenter = 0.3;  ///< largest distance of the centre of mass from the frame's origin, in the body's size
};

/// Sweeps for the two polygons: B starts on a circle about A and heads past its centre; both drift along together.
void approach(Dice& dice, ToiQuery& query, double sizeA, double sizeB, const Approach& how);

/// The query seen from a frame that is turned, and from one in which both bodies drift.
void turnScene(ToiQuery& query, double angle);
void drift(ToiQuery& query, DVec2 along);
void swapBodies(ToiQuery& query);

double separationAtFraction(const ToiQuery& query, double fraction);
/// Moves B along the line of the centres, keeping its travel, until the query starts at the wanted separation.
void startAt(ToiQuery& query, double separation);
/// Moves B's path aside until the smallest separation on it is the wanted one, as nearly as some rounds can do.
void passAt(ToiQuery& query, double separation);

}  // namespace swept::cases
