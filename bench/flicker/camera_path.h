#pragma once
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/components.h"
#include "gnomon/registry.h"
#include "gnomon/result.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/traced_world.h"

/// Camera movements through a still scene.
namespace gnomon::bench {

/// Frames of a path's first pose after which sizes and holds of the automatic choices have settled.
inline constexpr int kPathSettlingFrames = 3;

struct CameraPath {
    std::string_view name, meaning;
};
/// Returns the paths: pan, walk, roll, zoom.
std::span<const CameraPath> camera_paths();

/// Returns the wanted names; all known ones if none is given. Error: "bench.WHAT", a name is unknown.
Result<std::vector<std::string>> chosen_names(const std::vector<std::string>& wanted,
                                              const std::vector<std::string>& known, const char* what);

/// Moves `start` along a path; share 0 is the start itself. distance_m: distance of what it looks at.
ConsumerItem on_path(const ConsumerItem& start, std::string_view path, double share, double distance_m);

/// Writes a consumer's place and lens to the camera entity it came from (without parent).
void place_camera(const ConsumerItem& consumer, ecs::Registry& world);
Transform transform_of(const ConsumerItem& consumer);

/// Returns the ray through a place of the picture, -1 to 1 each way. Its parameter counts metres along the view.
oracle::ExactRay ray_through(const ConsumerItem& consumer, const glm::dvec2& place, const glm::dvec3& origin_ws_m);
/// Returns where the picture shows a point before the camera, pixels: whole numbers are pixels' centres, row 0 is the
/// lowest.
glm::dvec2 place_px(const ConsumerItem& consumer, const glm::dvec3& point_ws_m);
/// Returns the width of a pixel at a point, across the view, metres.
double pixel_width_m(const ConsumerItem& consumer, const glm::dvec3& point_ws_m);
/// Returns whether the camera sees a point, clear of the view's border by the rounding of its planes.
bool in_view(const ConsumerItem& consumer, const glm::dvec3& point_ws_m);

}  // namespace gnomon::bench
