#pragma once

#include <cmath>

#include <swept/shapes/dvec2.h>

namespace swept::oracle {

/// The oracle's own vector, so that it shares nothing with what it judges but the types of its input.
struct PlainVec {
    double x = 0;
    double y = 0;
};

constexpr PlainVec plain(DVec2 v) { return {v.x, v.y}; }
constexpr PlainVec operator+(PlainVec a, PlainVec b) { return {a.x + b.x, a.y + b.y}; }
constexpr PlainVec operator-(PlainVec a, PlainVec b) { return {a.x - b.x, a.y - b.y}; }
constexpr PlainVec operator-(PlainVec a) { return {-a.x, -a.y}; }
constexpr PlainVec operator*(double s, PlainVec a) { return {s * a.x, s * a.y}; }
constexpr double dot(PlainVec a, PlainVec b) { return a.x * b.x + a.y * b.y; }
inline double length(PlainVec a) { return std::sqrt(dot(a, a)); }

}  // namespace swept::oracle
