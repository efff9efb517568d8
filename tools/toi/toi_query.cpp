#include "toi_query.h"

#include <ostream>

#include "../writers/number_text.h"

namespace swept {
namespace {

void append(std::string& text, DVec2 v) {
    text += '[';
    appendJsonNumber(text, v.x);
    text += ", ";
    appendJsonNumber(text, v.y);
    text += ']';
}

void append(std::string& text, const Sweep& sweep) {
    text += "{\"localCenter\": ";
    append(text, sweep.localCenter);
    text += ", \"c0\": ";
    append(text, sweep.c0);
    text += ", \"c1\": ";
    append(text, sweep.c1);
    text += ", \"k\": ";
    append(text, sweep.k);
    text += ", \"a0\": ";
    appendJsonNumber(text, sweep.a0);
    text += ", \"a1\": ";
    appendJsonNumber(text, sweep.a1);
    text += '}';
}

void append(std::string& text, const ToiPolygon& polygon, const Sweep& sweep) {
    text += "{\"vertices\": [";
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        if (i > 0) { text += ", "; }
        append(text, polygon.vertices[i]);
    }
    text += "], \"radius\": ";
    appendJsonNumber(text, polygon.radius);
    text += ", \"sweep\": ";
    append(text, sweep);
    text += '}';
}

}  // namespace

std::string queryLine(const ToiQuery& query, std::string_view id, std::string_view family) {
    std::string text = "{\"id\": \"" + std::string(id) + "\", \"family\": \"" + std::string(family) + "\", \"a\": ";
    append(text, query.a, query.sweepA);
    text += ", \"b\": ";
    append(text, query.b, query.sweepB);
    text += ", \"tMax\": ";
    appendJsonNumber(text, query.settings.tMax);
    text += ", \"target\": ";
    appendJsonNumber(text, query.settings.target);
    text += ", \"tolerance\": ";
    appendJsonNumber(text, query.settings.tolerance);
    text += '}';
    return text;
}

std::ostream& operator<<(std::ostream& out, const ToiQuery& query) { return out << queryLine(query, "case", "test"); }

}  // namespace swept
