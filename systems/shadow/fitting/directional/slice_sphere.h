#pragma once
#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

struct SliceSphere {
    double centre_m = 0.0;  // distance of the centre along the view
    double radius_m = 0.0;
};

/// Returns the smallest sphere around the slice of a camera's view from from_m to to_m, in view space. 0 <= from_m <=
/// to_m. Its centre lies on the view's axis, equally far from the corners of both ends, but at most in the far end. It
/// depends on lens and slice alone, so that moving and turning the camera changes nothing.
SliceSphere slice_sphere(const ConsumerItem& consumer, double from_m, double to_m);

}  // namespace gnomon::shadow
