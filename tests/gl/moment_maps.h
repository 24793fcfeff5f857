#pragma once
#include "systems/shadow/passes/prefilter_pass.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/map_textures.h"
#include "systems/shadow/request/prefilter_settings.h"
#include "tests/gl/gl_test_context.h"

namespace gnomon {

/// Prefiltered maps of depth maps that are drawn by hand.
class MomentMapTest : public GlTest {
protected:
    struct Range {
        double near_m, far_m;
    };
    /// `depths`: reversed depth, one layer or six faces, of a view from near to far.
    gl::TextureHandle moments_of(const shadow::FilterRow& row, const LightItem& light, gl::TextureHandle depths,
                                 std::uint32_t size_px, Range range) {
        const LightKind kind = light.kind;
        const auto& kind_row = shadow::light_kind_row(kind);
        SceneSnapshot scene;
        scene.lights.emplace_back();
        shadow::ShadowFrame frame;
        shadow::ShadowDemand demand;
        demand.filter = row.id;
        demand.filtering = shadow::filter_demand(row, light, size_px);
        demand.moments = shadow::moment_demand(row, light, size_px);
        frame.demands = {demand};
        frame.sets.resize(1);
        frame.cpu_us.resize(1);
        const gl::TextureDesc map{.label = "moments", .kind = kind_row.texture, .format = demand.moments.format, .width = size_px, .height = size_px, .mips = demand.moments.levels};
        const auto moments = keep(device().create_texture(map, {}));
        const std::uint32_t rows = size_px + 2 * shadow::scratch_rows(demand, kind == LightKind::point);
        const auto scratch = keep(device().create_texture({.label = "scratch", .format = demand.moments.format, .width = size_px, .height = rows}, {}));
        const auto scratch_target = keep(device().create_target({"scratch", {{scratch}}, {}}));
        for (std::uint32_t layer = 0; layer < gl::layer_count(map); ++layer) {
            frame.views.push_back(view_of(kind, layer, range));
            shadow::ShadowSlot slot;
            slot.texture = depths;
            slot.moments = moments;
            slot.moment_target = keep(device().create_target({"moments", {{moments, static_cast<std::int32_t>(layer)}}, {}}));
            if (demand.filtering.size > 1) {
                slot.scratch = scratch;
                slot.scratch_target = scratch_target;
            }
            slot.size_px = size_px;
            slot.convert = true;
            frame.slots.push_back(slot);
        }
        shadow::MomentRecorder recorder(device());
        recorder.prepare(frame);
        gl::CommandList list;
        recorder.record(scene, frame, list);
        run(list);
        return moments;
    }

private:
    static shadow::ShadowView view_of(LightKind kind, std::uint32_t layer, Range range) {
        shadow::ShadowView view;
        view.layer = layer;
        view.projection = kind == LightKind::directional ? shadow::ViewProjection::orthographic
                          : kind == LightKind::spot      ? shadow::ViewProjection::perspective
                                                         : shadow::ViewProjection::cube_face;
        view.near_m = range.near_m;
        view.far_m = range.far_m;
        view.depth_alpha = -range.near_m / (range.far_m - range.near_m);
        view.depth_beta = range.near_m * range.far_m / (range.far_m - range.near_m);
        return view;
    }
};

}  // namespace gnomon
