#pragma once
#include <string>
#include <vector>

#include "bench/fit_drawings/plane_plot.h"
#include "bench/flicker/map_readback.h"

namespace gnomon::bench {

/// Returns the indices of a light's views.
std::vector<std::uint32_t> views_of(const shadow::ShadowFrame& frame, std::uint32_t light);

/// A sun's fit, seen along the light. The frames must outlive it; the light must have views.
class SunDrawing {
public:
    SunDrawing(const ShadowFrames& frames, std::uint32_t light);

    /// Draws all cascades, and the first of them with its texels.
    std::string cascades(const std::string& fit) const;
    /// Draws the last cascade across the light, and as its map shows it. Where the map is warped the two differ.
    std::string warp() const;

private:
    using Projection = std::function<glm::dvec2(const glm::dvec3& p_ws)>;

    glm::dvec2 flat(const glm::dvec3& p_ws) const;
    MapOutline outline(const shadow::ShadowView& view) const;
    ConsumerItem slice(std::size_t cascade) const;
    std::vector<glm::dvec3> receivers_in(const ConsumerItem& part) const;
    void draw_boxes(Panel& panel) const;
    void draw_camera(Panel& panel) const;
    void draw_slice(Panel& panel, std::size_t cascade, const Projection& projection) const;
    std::string draw_cascades(Svg& svg, const glm::dvec2& corner, const Points& shown, bool near, bool spheres) const;

    const SceneSnapshot& scene_;
    const shadow::ShadowFrame& frame_;
    const ConsumerItem& camera_;
    glm::dmat3 basis_;
    std::vector<std::uint32_t> views_;
};

}  // namespace gnomon::bench
