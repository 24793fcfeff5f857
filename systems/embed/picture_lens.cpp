#include "systems/embed/picture_lens.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/math/finite.h"
#include "systems/extract/camera_view.h"

namespace gnomon::embed {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Returns whether the matrix has only the elements that a projection needs: x and y are scaled and shifted alone.
bool is_projection(const glm::dmat4& m) {
    const bool separate = m[0][1] == 0.0 && m[0][2] == 0.0 && m[0][3] == 0.0 && m[1][0] == 0.0 && m[1][2] == 0.0 &&
                          m[1][3] == 0.0 && m[3][3] >= 0.0;
    const glm::dvec4& unused = m[2][3] == 0.0 ? m[2] : m[3];  // a shear, or an eye moved to the side
    return separate && unused.x == 0.0 && unused.y == 0.0 && m[0][0] > 0.0 && m[1][1] > 0.0;
}

/// Sets the range of distances that depths 0 and 1 stand for. Returns false if there is none.
bool put_range(lighting::PictureLens& lens) {
    const auto distance = [&](double depth) {
        return lens.orthographic ? lens.scale * depth + lens.offset : lens.scale / (depth + lens.offset);
    };
    double near_m = distance(lens.reversed ? 1.0 : 0.0), far_m = distance(lens.reversed ? 0.0 : 1.0);
    // A far plane at infinity may round to behind the camera.
    if (!lens.orthographic && !(far_m > near_m)) far_m = kInfinite;
    lens.near_m = near_m;
    lens.far_m = far_m;
    return std::isfinite(near_m) && near_m < far_m && (lens.orthographic ? std::isfinite(far_m) : near_m > 0.0);
}

}  // namespace

std::optional<lighting::PictureLens> lens_of(const glm::dmat4& clip_from_view, ClipDepth clip_depth) {
    glm::dmat4 m = clip_from_view;
    if (!math::is_finite(m) || !is_projection(m)) return std::nullopt;
    lighting::PictureLens lens;
    lens.orthographic = m[2][3] == 0.0;
    const double w = lens.orthographic ? m[3][3] : -m[2][3];
    if (!(w > 0.0) || (!lens.orthographic && m[3][3] != 0.0)) return std::nullopt;
    m /= w;
    // A depth is step * z + middle of clip space's z after division.
    const double step = clip_depth == ClipDepth::zero_to_one ? 1.0 : 0.5, middle = 1.0 - step;
    lens.half = {1.0 / m[0][0], 1.0 / m[1][1]};
    if (m[2][2] == 0.0 && lens.orthographic) return std::nullopt;
    if (lens.orthographic) {
        lens.shift = {-m[3][0], -m[3][1]};
        lens.scale = -1.0 / (step * m[2][2]);
        lens.offset = (middle + step * m[3][2]) / (step * m[2][2]);
        lens.reversed = lens.scale < 0.0;
    } else {
        lens.shift = {m[2][0], m[2][1]};
        lens.scale = step * m[3][2];
        lens.offset = step * m[2][2] - middle;
        lens.reversed = lens.scale > 0.0;
    }
    if (!put_range(lens)) return std::nullopt;
    return lens;
}

void update_reach(const lighting::PictureLens& lens, glm::uvec2 size_px, PictureReach& held) {
    constexpr double kMostJitter_px = 2.0, kMostSpare_px = 4.0;
    const glm::dvec2 pixel = 2.0 / glm::dvec2(size_px), off = glm::abs(lens.shift);
    const glm::dvec2 moved = glm::abs(lens.shift - held.shift);
    const auto all = [](bool x, bool y) { return x && y; };
    const bool same = size_px == held.size_px && lens.half == held.half;
    const bool within = all(off.x <= held.reach.x, off.y <= held.reach.y);
    const bool tight =
        all(held.reach.x <= off.x + kMostSpare_px * pixel.x, held.reach.y <= off.y + kMostSpare_px * pixel.y);
    const bool starts = off != glm::dvec2(0.0) && all(off.x < pixel.x, off.y < pixel.y);
    const bool moves = same && moved != glm::dvec2(0.0) &&
                       all(moved.x <= kMostJitter_px * pixel.x, moved.y <= kMostJitter_px * pixel.y);
    const bool jitters = starts || moves;
    if (!(same && within && tight) || (jitters && !held.jitters)) {
        held.reach = jitters ? off + pixel : off;
        held.jitters = jitters;
    }
    held.size_px = size_px;
    held.half = lens.half;
    held.shift = lens.shift;
}

bool put_view(const glm::dmat4& world_from_view, const PictureReach& reach, lighting::PictureLens& lens,
              ConsumerItem& consumer) {
    if (!math::is_finite(world_from_view)) return false;
    const glm::dmat3 basis(world_from_view);
    consumer.rotation_ws = orientation(basis);
    constexpr double kRigid = 1.0e-3;  // a share: matrices of floats that were multiplied often stay far below
    for (int axis = 0; axis < 3; ++axis)
        if (!(glm::distance(basis[axis], consumer.rotation_ws[axis]) <= kRigid)) return false;
    consumer.position_ws_m = glm::dvec3(world_from_view[3]);
    if (lens.orthographic && lens.near_m < 0.0) {
        consumer.position_ws_m -= consumer.rotation_ws[2] * lens.near_m;
        lens.offset -= lens.near_m;
        lens.far_m -= lens.near_m;
        lens.near_m = 0.0;
    }
    const glm::dvec2 half = lens.half * (1.0 + reach.reach);
    consumer.viewport_px = glm::uvec2(glm::ceil(glm::dvec2(reach.size_px) * (1.0 + reach.reach)));
    const double aspect = static_cast<double>(consumer.viewport_px.x) / static_cast<double>(consumer.viewport_px.y);
    const double half_y = std::max(half.y, half.x / aspect);
    consumer.projection = lens.orthographic ? CameraProjection::orthographic : CameraProjection::perspective;
    consumer.half_height_m = half_y;
    consumer.fov_y_rad = 2.0 * std::atan(half_y);
    constexpr double kRounding = 1.0e-6;  // a surface at the near plane must not round to before it
    consumer.near_m = lens.near_m * (1.0 - kRounding);
    consumer.far_m = lens.far_m * (1.0 + kRounding);
    return true;
}

}  // namespace gnomon::embed
