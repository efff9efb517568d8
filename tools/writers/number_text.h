#pragma once

#include <cstdint>
#include <string>

namespace swept {

/// Appends the shortest decimal that reads back as the same double ("0.1", "-0", "1e+22", "nan", "inf").
void appendNumber(std::string& text, double value);

/// As `appendNumber`, for JSON, which has no NaN and no infinity: those become `null`.
void appendJsonNumber(std::string& text, double value);

/// A number for a human: at most `digits` significant digits.
std::string roundedText(double value, int digits = 4);

/// The same of a number that is not negative, but never a larger number than it is: for what must not be exceeded.
std::string roundedDownText(double value, int digits);

/// "1 step", "2 steps".
std::string countText(std::int64_t count, const std::string& noun);

/// The same number, but 0 for −0, whose sign tells a reader of results nothing.
constexpr double withoutMinusZero(double value) { return value + 0.0; }

}  // namespace swept
