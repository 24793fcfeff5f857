#pragma once
#include "systems/extract/snapshot.h"

namespace gnomon::shadow {

struct SliceSphere {
    double centre_m = 0.0;  // distance of the centre along the view
    double radius_m = 0.0;
};

/// The smallest sphere around the slice of what the consumer sees from from_m to to_m, in view space: its centre lies
/// on the view's axis, where the corners of both ends are equally far, or in the far end if that would lie beyond it.
/// Depends on the lens and the slice alone, so that moving and turning the camera changes nothing. 0 <= from_m <= to_m.
SliceSphere slice_sphere(const ConsumerItem& consumer, double from_m, double to_m);

}  // namespace gnomon::shadow
