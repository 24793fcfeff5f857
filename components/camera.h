#pragma once

namespace gnomon {

enum class CameraProjection : unsigned char { perspective, orthographic };

/// Looks along its own -Z with +Y up. Each camera with `active` gets shadows. What no active camera sees costs nothing.
struct Camera {
    CameraProjection projection = CameraProjection::perspective;
    double fov_y_rad = 0.9;      // perspective: full vertical angle, (0, pi)
    double half_height_m = 5.0;  // orthographic: half of the visible height
    double near_m = 0.05;        // > 0 for perspective
    double far_m = 1.0e9;  // > near; perspective: may be infinite; orthographic: the view ends where the scene does
    /// Width by height of a frame that stays visible whole: a narrower picture shows a taller view. 0 or NaN: only the
    /// height counts.
    double frame_aspect = 0.0;
    bool active = true;
};

}  // namespace gnomon
