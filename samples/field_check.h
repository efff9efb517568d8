#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "json_strict.h"
#include "scene_fields.h"
#include "scene_names.h"
#include "scene_reader.h"

namespace swept {

using NameIndex = std::map<std::string, std::size_t, std::less<>>;  // place in the list, by name

/// What every part of a scene is checked for: numbers within the ranges of the table of fields, names that are given
/// once. Keeps the first error.
class FieldCheck {
public:
    /// @param largest  no number may exceed it, no positive one its inverse
    explicit FieldCheck(double largest) : largest_(largest) {}

protected:
    double largest() const { return largest_; }
    std::optional<SceneError> takeError() { return std::move(error_); }
    bool fail(SceneError error) {
        if (!error_) { error_ = std::move(error); }
        return false;
    }
    bool fail(const Place& place, std::string reason) { return fail({"", place.pointer(), std::move(reason)}); }

    bool check(double value, const Place& place, const Range& range) {
        if (!std::isfinite(value)) { return fail(place, "must be finite, not " + shortestNumber(value)); }
        const bool tooLow = range.lowestExcluded ? value <= range.lowest : value < range.lowest;
        if (tooLow || value > range.highest) { return fail(place, demandOf(range) + ", not " + shortestNumber(value)); }
        if (std::fabs(value) > largest_) {
            return fail(place, shortestNumber(value) + " is too large: the largest number allowed is " +
                                   shortestNumber(largest_));
        }
        if (range.lowestExcluded && value < 1 / largest_) {
            return fail(place, shortestNumber(value) + " is too small: single precision would make it 0");
        }
        return true;
    }
    bool check(int value, const Place& place, const Range& range) {
        return check(static_cast<double>(value), place, range);
    }
    bool check(DVec2 value, const Place& place, const Range& range) {
        return check(value.x, place.at(0), range) && check(value.y, place.at(1), range);
    }
    bool check(const std::array<DVec2, 2>& points, const Place& place, const Range& range) {
        return check(points[0], place.at(0), range) && check(points[1], place.at(1), range);
    }
    bool check(const std::vector<DVec2>& points, const Place& place, const Range& range) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!check(points[i], place.at(i), range)) { return false; }
        }
        return true;
    }
    bool check(const std::vector<SurfaceDescription>& surfaces, const Place& place, const Range&) {
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            if (!checkFields(surfaces[i], place.at(i))) { return false; }
        }
        return true;
    }
    template <class Value>
    bool check(const std::optional<Value>& value, const Place& place, const Range& range) {
        return !value || check(*value, place, range);
    }
    template <Described Object>
    bool check(const Object& object, const Place& place, const Range&) {
        return checkFields(object, place);
    }
    // Words, truths, filters' bit sets have no wrong values; bodies, shapes and joints have their own walk below.
    bool check(const std::string&, const Place&, const Range&) { return true; }
    bool check(bool, const Place&, const Range&) { return true; }
    bool check(std::uint32_t, const Place&, const Range&) { return true; }
    bool check(SceneBodyType, const Place&, const Range&) { return true; }
    bool check(SceneContinuous, const Place&, const Range&) { return true; }
    bool check(SceneProfile, const Place&, const Range&) { return true; }
    bool check(SceneBroadphase, const Place&, const Range&) { return true; }
    bool check(MixingRule, const Place&, const Range&) { return true; }
    bool check(const std::vector<ShapeDescription>&, const Place&, const Range&) { return true; }
    bool check(const std::vector<BodyDescription>&, const Place&, const Range&) { return true; }
    bool check(const std::vector<JointDescription>&, const Place&, const Range&) { return true; }

    template <Described Object>
    bool checkFields(const Object& object, const Place& place) {
        bool good = true;
        forEachField<Object>([&](const auto& field) {
            if (!good) { return; }
            if constexpr (kBare<Object>) {
                good = check(object.*(field.member), place, field.range);
            } else {
                good = check(object.*(field.member), place.at(std::string_view(field.key)), field.range);
            }
        });
        return good;
    }

    // Given names must differ from each other and from the names of the unnamed (`body<index>`).
    template <class Named>
    bool checkNames(const std::vector<Named>& elements, const std::string& prefix, const Place& list,
                    NameIndex& index) {
        for (std::size_t i = 0; i < elements.size(); ++i) {
            if (elements[i].name.empty()) { index.emplace(prefix + std::to_string(i), i); }
        }
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const std::string& name = elements[i].name;
            if (name.empty()) { continue; }
            const auto [other, isNew] = index.emplace(name, i);
            if (isNew) { continue; }
            const std::size_t j = other->second;
            const std::string taken = elements[j].name.empty() ? " is the name of the unnamed " : " is the name of ";
            const Place element = list.at(i);
            return fail(element.at("name"), inQuotes(name) + taken + list.at(j).pointer() + " already");
        }
        return true;
    }

private:
    // "must be …" for a range; empty when the range allows every number.
    static std::string demandOf(const Range& range) {
        if (std::isfinite(range.lowest) && std::isfinite(range.highest)) {
            return "must be from " + shortestNumber(range.lowest) + " to " + shortestNumber(range.highest);
        }
        if (!std::isfinite(range.lowest)) { return "must be a number"; }
        return (range.lowestExcluded ? "must be greater than " : "must be at least ") + shortestNumber(range.lowest);
    }

    double largest_;
    std::optional<SceneError> error_;
};

}  // namespace swept
