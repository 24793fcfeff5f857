#include <algorithm>
#include <cstring>

#include "engine/math/projection.h"
#include "systems/extract/instance_order.h"
#include "systems/shadow/passes/depth_pass.h"
#include "systems/shadow/passes/mesh_draw_ranges.h"

/// Gathering of the draws of each depth pass.
namespace gnomon::shadow {
namespace {

/// Orders casters by mesh, then mirrored ones last, then by index. Few draws then need a change of culling.
bool drawn_before(const SceneSnapshot& scene, std::uint32_t a, std::uint32_t b) {
    const InstanceItem &first = scene.instances[a], &second = scene.instances[b];
    if (first.mesh != second.mesh) return first.mesh < second.mesh;
    return first.winding.mirrored != second.winding.mirrored ? second.winding.mirrored : a < b;
}

}  // namespace

void DepthPass::append_uniforms(const ShadowView& view, std::size_t at) {
    const math::TwoFloat3 anchor = math::split(view.pose.anchor_ws_m);
    const DepthViewRecord record{view.clip_from_anchor, glm::vec4(anchor.high, 0.0f),
                                 glm::vec4(anchor.low, static_cast<float>(view.layer))};
    std::memcpy(view_scratch_.data() + at, &record, sizeof record);
}

/// Gathers the casters of one view's group.
DepthPass::Group DepthPass::gather_view(const SceneSnapshot& scene, std::span<const std::uint32_t> casters) {
    const std::size_t first = caster_scratch_.size();
    caster_scratch_.insert(caster_scratch_.end(), casters.begin(), casters.end());
    const auto mirrored = [&](std::uint32_t i) { return scene.instances[i].winding.mirrored; };
    if (std::any_of(casters.begin(), casters.end(), mirrored))
        std::sort(caster_scratch_.begin() + static_cast<std::ptrdiff_t>(first), caster_scratch_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return drawn_before(scene, a, b); });
    layer_scratch_.resize(caster_scratch_.size(), 0);
    return {{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(casters.size())}, 0};
}

/// Gathers the casters of a group over all views, sorted by mesh: one draw per mesh draws it into every face.
DepthPass::Group DepthPass::gather_layers(const PassInputs& in, const Pass& pass, bool moving) {
    pair_scratch_.clear();
    for (std::size_t v = pass.first; v < pass.end; ++v) {
        if (!in.drawn.is_drawn(v)) continue;
        const ShadowView& view = in.drawn.view(v);
        const FittedViews& fitted = in.drawn.fitted;
        for (const std::uint32_t i : moving ? fitted.moving_casters_of(view) : fitted.static_casters_of(view))
            pair_scratch_.emplace_back(i, view.layer);
    }
    std::sort(pair_scratch_.begin(), pair_scratch_.end(), [&](const auto& a, const auto& b) {
        return a.first != b.first ? drawn_before(in.scene, a.first, b.first) : a.second < b.second;
    });
    const IndexRange range{static_cast<std::uint32_t>(caster_scratch_.size()),
                           static_cast<std::uint32_t>(pair_scratch_.size())};
    for (const auto& [item, layer] : pair_scratch_) {
        caster_scratch_.push_back(item);
        layer_scratch_.push_back(layer);
    }
    return {range, 0};
}

/// Appends the items of a group with gathered casters, in the order in which draw() reads them.
void DepthPass::append_items(const PassInputs& in, bool triangles, Group& group) {
    group.first_item = static_cast<std::uint32_t>(item_scratch_.size());
    const auto casters = std::span(caster_scratch_).subspan(group.casters.first, group.casters.count);
    const auto append = [&](std::uint32_t i, std::uint32_t first_triangle) {
        item_scratch_.push_back({in.scene.instances[casters[i]].gpu_slot,
                                 layer_scratch_[group.casters.first + i] | first_triangle << kLayerBits});
    };
    if (!triangles) {
        for (std::uint32_t i = 0; i < casters.size(); ++i) append(i, 0);
        return;
    }
    for_each_mesh_run(in.scene, casters, [&](std::uint32_t mesh, std::uint32_t first, std::uint32_t count) {
        for_each_depth_run(in.gpu, mesh, [&](const DepthRun& run) {
            for (std::uint32_t i = first; i < first + count; ++i)
                append(i, run.engine ? kNoTriangle : run.first_index / 3);
        });
    });
}

/// Appends the matrices of a pass's views; a layered pass has them by face.
void DepthPass::gather_uniforms(const DrawnViews& drawn, Pass& pass) {
    const std::size_t at = view_scratch_.size();
    pass.uniform_offset = static_cast<std::uint32_t>(at);
    const std::size_t records = pass.layered ? kFaces : 1;
    view_scratch_.resize(
        at + aligned(static_cast<std::uint32_t>(records * sizeof(DepthViewRecord)), device_.info().uniform_alignment));
    pass.views = 0;
    for (std::size_t v = pass.first; v < pass.end; ++v) {
        if (!drawn.is_drawn(v)) continue;
        const ShadowView& view = drawn.view(v);
        append_uniforms(view, at + (pass.layered ? view.layer * sizeof(DepthViewRecord) : 0));
        ++pass.views;
    }
}

/// Gathers what this frame draws, pass by pass.
void DepthPass::gather(const PassInputs& in) {
    passes_.clear();
    layer_scratch_.clear();
    caster_scratch_.clear();
    item_scratch_.clear();
    view_scratch_.clear();
    const FittedViews& fitted = in.drawn.fitted;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!in.drawn.is_drawn(v)) continue;
        const ShadowView& view = in.drawn.view(v);
        Pass pass{v, v + 1, is_layered(in, v), 1, 0, {}, {}};
        if (pass.layered) pass.end = fitted.lights[view.light].views.end();
        gather_uniforms(in.drawn, pass);
        if (pass.layered) {
            pass.still = gather_layers(in, pass, false);
            pass.moving = gather_layers(in, pass, true);
        } else {
            if (in.drawn.updates[v].copy.use != StaticCopyUse::copy)
                pass.still = gather_view(in.scene, fitted.static_casters_of(view));
            pass.moving = gather_view(in.scene, fitted.moving_casters_of(view));
        }
        const bool triangles = static_cast<bool>(in.drawn.maps[v].triangles);
        append_items(in, triangles, pass.still);
        append_items(in, triangles, pass.moving);
        passes_.push_back(pass);
        v = pass.end - 1;
    }
}

}  // namespace gnomon::shadow
