#pragma once

#include "interval.h"
#include "plain_vec.h"

namespace swept::oracle {

/// How a body turns in the course of a sweep, in interval arithmetic: at a constant rate, as ours do, or mixed, as
/// those of Box2D 3 do. Radians and their derivatives by the fraction.
///
/// Mixed: the rotations of both ends, as vectors (cosine, sine), are mixed linearly and normalised. The vector
/// p(t) = from + t (to − from) has the angle φ with φ′ = (p × p′)/|p|² = (from × to)/|p|², and since from × to does not
/// change, φ″ = −2 φ′ (p·p′)/|p|². That is the shorter way round, slow at the ends and fast in the middle.
class Turning {
public:
    static Turning steady(double from, double to);
    static Turning mixed(PlainVec from, PlainVec to);

    bool isSteady() const { return isSteady_; }
    SinCos at(double fraction) const;
    /// Enclosures over all fractions of an interval; infinite where the mixed vector may vanish.
    Interval rateOver(Interval fractions) const;
    Interval rateChangeOver(Interval fractions) const;

    /// In plain double: cosine and sine. A guess.
    PlainVec guess(double fraction) const;

private:
    bool isSteady_ = true;
    double plainFrom_ = 0;  // steady: angles
    double plainTo_ = 0;
    Interval rate_;
    PlainVec from_;  // mixed: cosines and sines
    PlainVec to_;
    Interval cross_;

    IntervalVec mixedAt(Interval fractions) const;
};

}  // namespace swept::oracle
