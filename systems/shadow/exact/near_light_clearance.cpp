#include "systems/shadow/exact/near_light_clearance.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "systems/extract/light_facts.h"
#include "systems/extract/scene_tree.h"
#include "systems/shadow/culling/triangle_distance.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::shadow {
namespace {

/// Inset of a map's sides, as a share of them. A triangle that ends at the border may continue in the next map.
constexpr double kInset = 1e-6;

/// Light frustum of one map, drawn or not.
struct ViewSides {
    glm::dmat3 axes{1.0};
    glm::dvec2 tan_low{-1.0}, tan_high{1.0};
    double near_m = 0.0;
    bool drawn = false;
};

class Clearance {
public:
    Clearance(const PassInputs& in, std::uint32_t light)
        : scene_(in.scene),
          gpu_(in.gpu),
          light_(in.scene.lights[light]),
          radius_m_(static_cast<double>(in.drawn.lights[light].request.map.filtering.source_radius_m)),
          within_m_(light_facts(light_.kind).area() ? radius_m_ : 0.0),
          least_m_(kClearance_radii * radius_m_) {
        // Faces without a view are looked up as well: nothing may stand before them.
        const bool cube = map_texture(light_, in.drawn.lights[light].request) == gl::TextureKind::cube;
        if (cube)
            for (std::uint32_t face = 0; face < kFaces; ++face) frusta_[face].axes = turned_axes(face);
        if (cube) count_ = kFaces;
        const IndexRange range = in.drawn.fitted.lights[light].views;
        for (std::size_t v = range.first; v < range.end(); ++v) {
            const ShadowView& view = in.drawn.view(v);
            ViewSides& frustum = frusta_[cube ? view.layer : count_++];
            frustum = {{view.pose.axis_u, view.pose.axis_v, view.pose.axis_back},
                       view.plane.tan_low,
                       view.plane.tan_high,
                       view.depth.near_m,
                       in.drawn.has_map(v) && !view.lit};
            least_m_ = std::max(least_m_, kClearance_nears * view.depth.near_m);
        }
    }

    double run() {
        const auto near_enough = [this](const math::Aabb& box) {
            const glm::dvec3 nearest = glm::clamp(light_.position_ws_m, box.min, box.max);
            const bool reaches = glm::distance(nearest, light_.position_ws_m) < least_m_;
            return reaches ? math::Overlap::partial : math::Overlap::outside;
        };
        visit_instances(scene_, near_enough, [this](std::uint32_t i) {
            if (!casts_under(light_, scene_.instances[i])) return;
            visit_triangles(gpu_, scene_.instances[i], light_.position_ws_m, [this](const Corners& c) {
                const double distance_m = distance_to(c);
                if (distance_m < least_m_ && (distance_m < within_m_ || counts(c))) least_m_ = distance_m;
            });
        });
        return least_m_;
    }

private:
    static constexpr std::size_t kFaces = 6;

    static glm::dmat3 turned_axes(std::uint32_t face) {
        const CubeFace& axes = cube_face(face);
        return glm::mat3_cast(cube_turn()) * glm::dmat3(axes.axis_u, axes.axis_v, axes.axis_back);
    }

    /// Returns whether a triangle counts for any light frustum. A place in one frustum knows of it from that frustum's
    /// map alone.
    bool counts(const Corners& corners) const {
        for (std::size_t i = 0; i < count_; ++i)
            if (is_near(frusta_[i], corners) && !shows_whole(frusta_[i], corners)) return true;
        return false;
    }

    /// Returns whether the triangle may come within the source's radius of the light frustum. All segments from its
    /// places to the source's middle lie in the frustum. Segments to the rest of the source are within the radius of
    /// them.
    bool is_near(const ViewSides& frustum, const Corners& corners) const {
        const glm::dvec3 &u = frustum.axes[0], &v = frustum.axes[1], &back = frustum.axes[2];
        const std::array<glm::dvec3, 5> outward{-u - frustum.tan_low.x * back, u + frustum.tan_high.x * back,
                                                -v - frustum.tan_low.y * back, v + frustum.tan_high.y * back, back};
        return std::none_of(outward.begin(), outward.end(), [&](const glm::dvec3& normal) {
            const double beyond = radius_m_ * glm::length(normal) * (1.0 + kInset);
            return std::all_of(corners.begin(), corners.end(),
                               [&](const glm::dvec3& c) { return glm::dot(c, normal) > beyond; });
        });
    }

    /// Returns whether the frustum's map shows the whole triangle.
    static bool shows_whole(const ViewSides& frustum, const Corners& corners) {
        const glm::dvec2 inset = kInset * (frustum.tan_high - frustum.tan_low);
        const auto inside = [&](const glm::dvec3& c) {
            const double z_m = -glm::dot(c, frustum.axes[2]);
            const glm::dvec2 at(glm::dot(c, frustum.axes[0]), glm::dot(c, frustum.axes[1]));
            const glm::dvec2 low = at - (frustum.tan_low + inset) * z_m, high = (frustum.tan_high - inset) * z_m - at;
            return z_m >= frustum.near_m && std::min({low.x, low.y, high.x, high.y}) >= 0.0;
        };
        return frustum.drawn && std::all_of(corners.begin(), corners.end(), inside);
    }

    const SceneSnapshot& scene_;
    const GpuScene& gpu_;
    const LightItem& light_;
    double radius_m_;
    double within_m_;  // casters nearer than this count in any case: places of an area light may lie before them
    double least_m_;
    std::array<ViewSides, kMaxViews> frusta_;
    std::size_t count_ = 0;
};

}  // namespace

void measure_clearances(const PassInputs& in, std::vector<double>& clearances_m, std::span<double> cpu_us) {
    clearances_m.assign(in.scene.lights.size(), 0.0);
    for (std::uint32_t i = 0; i < in.scene.lights.size(); ++i) {
        const ShadowRequest& request = in.drawn.lights[i].request;
        const bool soft = filter_row(request.map.filter).storage.occluder_pyramid;
        if (!soft || in.drawn.statuses[i].is_skipped() || request.rays.only ||
            light_facts(in.scene.lights[i].kind).parallel)
            continue;
        const LightTimer time(cpu_us, i);
        clearances_m[i] = Clearance(in, i).run();
    }
}

}  // namespace gnomon::shadow
