#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "../../samples/runner.h"
#include "../../toi/toi_method.h"
#include "toi_query.h"

/// The core of `swept toi` and `swept distance`: one JSON line in, one JSON line out.

namespace swept {

struct LineAnswer {
    std::string text;  ///< one JSON object without a line break
    bool good = true;  ///< false: the text is {"id", "error"}
};

/// {"id", "state", "t", "separation", "normal", "pointA", "pointB", "iterations", "target", "tolerance"}.
LineAnswer answerToiLine(std::string_view line, ToiMethod method = ToiMethod::certified);

/// The query of a line, with the defaults filled in and all of it checked.
/// @return nothing, or what is wrong with the line, and where.
std::optional<std::string> readToiLine(std::string_view line, ToiQuery& query);

/// At fraction 0: {"id", "distance", "normal", "pointA", "pointB", "iterations"}.
/// @param precision  of the distance function; the numbers of the line are rounded to it relative to the bodies'
/// centres.
LineAnswer answerDistanceLine(std::string_view line, Precision precision = Precision::f64);

/// What is wrong with a line, as readToiLine tells it, with the line's own number instead of that of its only one.
std::string namingTheLine(const std::string& reason, int number);

/// Answers each line in order; skips blank ones. The error of a bad one begins with "line N", counted from 1.
/// @param answer  one of the functions above with its second argument bound.
/// @return 0, or 2 when a line was bad.
int answerQueries(std::istream& in, std::ostream& out, const std::function<LineAnswer(std::string_view)>& answer);

}  // namespace swept
