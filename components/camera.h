#pragma once

namespace gnomon {

enum class CameraProjection : unsigned char { perspective, orthographic };

/// A camera looks along its own -Z with +Y up. Every camera entity with `active` is a consumer
/// of shadows: what no active camera sees, costs nothing.
struct Camera {
    CameraProjection projection = CameraProjection::perspective;
    double fov_y_rad = 0.9;       // perspective: full vertical angle, (0, pi)
    double half_height_m = 5.0;   // orthographic: half of the visible height
    double near_m = 0.05;         // > 0 for perspective
    double far_m = 1.0e9;         // > near; infinity is allowed for perspective. Orthographic views end with what they show
    /// Width by height of a frame that is to be seen whole: where the picture is narrower, the view is made higher.
    /// 0 or NaN: the height alone counts.
    double frame_aspect = 0.0;
    bool active = true;
};

}  // namespace gnomon
