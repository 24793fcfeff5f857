#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "engine/math/projection.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/passes/depth_pass.h"

/// Gathering of the draws of each depth pass.
namespace gnomon::shadow {
namespace {

/// Returns how the draws of a view that has a map are gathered.
DepthDraws::Way way_of(const PassInputs& in, std::size_t v) {
    const ShadowView& view = in.drawn.view(v);
    const bool culls = in.scene.lights[view.light].shadow.caster_faces != CasterFaces::both;
    return {static_cast<bool>(in.drawn.maps[v].triangles), static_cast<bool>(in.drawn.maps[v].sheets.second), culls,
            is_parallel(view), apex_ws_m(view)};
}

DepthDraws::Casters casters_of(const DrawnViews& drawn, std::size_t v, bool moving) {
    const ShadowView& view = drawn.view(v);
    if (!moving && drawn.updates[v].copy.use == StaticCopyUse::copy) return {};
    const DepthDraws::Casters all{drawn.fitted.casters_of(view), {}, drawn.fitted.meshes_of(view)};
    return moving ? all.part(view.static_casters, all.instances.size()) : all.part(0, view.static_casters);
}

}  // namespace

void DepthPass::append_uniforms(const ShadowView& view, std::uint32_t triangle_bits, std::size_t at) {
    const math::TwoFloat3 anchor = math::split(view.pose.anchor_ws_m);
    const DepthViewRecord record{view.clip_from_anchor, glm::vec4(anchor.high, static_cast<float>(triangle_bits)),
                                 glm::vec4(anchor.low, static_cast<float>(view.layer))};
    std::memcpy(view_scratch_.data() + at, &record, sizeof record);
}

/// Merges the casters of all views of a pass into one list. It is sorted by the mesh that is drawn and by index, as
/// they are, so that one draw per mesh serves every face. Valid until the next call.
DepthDraws::Casters DepthPass::merge_layers(const PassInputs& in, const Pass& pass, bool moving) {
    struct Rest {
        DepthDraws::Casters casters;
        std::uint32_t layer = 0;
        std::size_t next = 0;  // first that is not yet merged
    };
    std::array<Rest, kFaces> rests;
    std::size_t count = 0;
    for (std::size_t v = pass.first; v < pass.end && count < kFaces; ++v)
        if (in.drawn.is_drawn(v)) rests[count++] = {casters_of(in.drawn, v, moving), in.drawn.view(v).layer};
    caster_scratch_.clear();
    layer_scratch_.clear();
    mesh_scratch_.clear();
    const bool proxies = std::any_of(rests.begin(), rests.begin() + static_cast<std::ptrdiff_t>(count),
                                     [](const Rest& rest) { return !rest.casters.meshes.empty(); });
    const auto key = [&](const Rest& rest) {  // mesh that is drawn, instance
        const std::uint32_t i = rest.casters.instances[rest.next];
        return std::pair(rest.casters.meshes.empty() ? in.scene.instances[i].mesh : rest.casters.meshes[rest.next], i);
    };
    const auto has_more = [](const Rest& rest) { return rest.next < rest.casters.instances.size(); };
    for (;;) {
        const Rest* next = nullptr;
        for (std::size_t i = 0; i < count; ++i)
            if (has_more(rests[i]) && (!next || key(rests[i]) < key(*next))) next = &rests[i];
        if (!next) return {caster_scratch_, layer_scratch_, mesh_scratch_};
        const auto first = key(*next);
        for (std::size_t i = 0; i < count; ++i) {
            if (!has_more(rests[i]) || key(rests[i]) != first) continue;
            if (proxies) mesh_scratch_.push_back(first.first);
            caster_scratch_.push_back(first.second);
            layer_scratch_.push_back(rests[i].layer);
            ++rests[i].next;
        }
    }
}

void DepthPass::end_group(Pass& pass, IndexRange& group) {
    group = draws_.end_group();
    pass.saved_triangles += draws_.saved_triangles();
}

/// Gathers the draws of a pass. Where maps have triangles, static casters come first, as in a copy of them, because the
/// first draw wins at equal depths.
void DepthPass::gather_casters(const PassInputs& in, Pass& pass) {
    const DepthDraws::Way way = way_of(in, pass.first);
    const bool apart = way.triangles || in.drawn.updates[pass.first].copy.use != StaticCopyUse::none;
    for (const bool moving : {false, true}) {
        draws_.add(in.scene, in.gpu, way,
                   pass.layered ? merge_layers(in, pass, moving) : casters_of(in.drawn, pass.first, moving));
        if (!moving && apart) end_group(pass, pass.still);
    }
    end_group(pass, apart ? pass.moving : pass.still);
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
        append_uniforms(view, drawn.maps[v].triangle_bits,
                        at + (pass.layered ? view.layer * sizeof(DepthViewRecord) : 0));
        ++pass.views;
    }
}

/// Gathers what this frame draws, pass by pass.
void DepthPass::gather(const PassInputs& in, const LightAccounts& accounts) {
    draws_.clear();
    wants_records_ = false;
    view_scratch_.clear();
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!in.drawn.is_drawn(v)) continue;
        const std::uint32_t light = in.drawn.view(v).light;
        const LightTimer time(accounts.cpu_us, light);
        Pass pass{v, v + 1, is_layered(in, v), 1, 0, {}, {}, 0};
        if (pass.layered) pass.end = in.drawn.fitted.lights[light].views.end();
        gather_uniforms(in.drawn, pass);
        gather_casters(in, pass);
        const auto is_several = [](const DepthDraws::Batch& batch) { return batch.draws.count > 1; };
        for (const IndexRange group : {pass.still, pass.moving}) {
            const auto batches = draws_.batches(group);
            wants_records_ |= in.scene.lights[light].tuning.maps.multi_draw &&
                              std::any_of(batches.begin(), batches.end(), is_several);
        }
        passes_.push_back(pass);
        v = pass.end - 1;
    }
}

}  // namespace gnomon::shadow
