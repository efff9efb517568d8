#include "sweep.h"

namespace swept {

Sweep part(const Sweep& sweep, double from, double to) {
    const double span = to - from;
    Sweep result = sweep;
    result.c0 = from > 0 ? centerAt(sweep, from) : sweep.c0;
    result.c1 = to < 1 ? centerAt(sweep, to) : sweep.c1;  // c0 + (c1 − c0) need not round to c1
    result.k = (span * span) * sweep.k;                   // second derivative 2k, in the new unit of time
    result.a0 = from > 0 ? angleAt(sweep, from) : sweep.a0;
    result.a1 = to < 1 ? angleAt(sweep, to) : sweep.a1;
    return result;
}

}  // namespace swept
