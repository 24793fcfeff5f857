#pragma once
#include <cstddef>
#include <string>

#include "tests/stability/hard_cases_world.h"

/// What must be true of any frame, decided in long double on the meshes' own triangles, with formulas of its own.
namespace gnomon::hard {

struct Verdict {
    std::size_t seen = 0;         // points of receivers that a camera sees and the light reaches
    std::size_t darkened = 0;     // seen points with an occluder
    std::size_t outside = 0;      // points in no view of a light that has views; of a lamp darkened points only
    std::size_t missed = 0;       // casters that darken a point and are not among its view's casters
    std::size_t not_finite = 0;   // views with a number that is none, or no volume
    std::size_t no_reason = 0;    // a light without views and without a reason, or with both
    std::size_t wrong_skip = 0;   // skipped although some seen point is darkened
    std::size_t audit_wrong = 0;  // rays on which Embree's candidates and all triangles disagree
    std::string first;            // the first finding, in words

    std::size_t wrong() const { return outside + missed + not_finite + no_reason + wrong_skip + audit_wrong; }
};

/// Judges the last frame of `stages` on rays through random places of the picture.
Verdict judge(const Stages& stages);

}  // namespace gnomon::hard
