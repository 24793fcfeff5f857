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
    /// Returns the moments of `depths`: reversed depth, one layer or six faces, of a view from near to far.
    gl::TextureHandle moments_of(const shadow::FilterRow& row, const LightItem& light, gl::TextureHandle depths,
                                 std::uint32_t size_px, Range range) {
        const LightKind kind = light.kind;
        const auto& kind_row = shadow::light_kind_row(kind);
        SceneSnapshot scene;
        scene.lights.emplace_back();
        shadow::ShadowFrame frame;
        frame.decisions.resize(1);
        frame.statuses.resize(1);
        shadow::MapSettings& settings = frame.decisions[0].request.map;
        settings.filter = row.id;
        settings.filtering = shadow::filter_settings(row, light, size_px);
        settings.moments = shadow::prefilter_settings(row, light, size_px);
        const gl::TextureDesc map{.label = "moments", .kind = kind_row.texture, .format = settings.moments.format, .width = size_px, .height = size_px, .mips = settings.moments.levels};
        const auto moments = keep(device().create_texture(map, {}));
        const std::uint32_t rows = size_px + 2 * shadow::scratch_rows(settings, kind == LightKind::point);
        const auto scratch = keep(device().create_texture({.label = "scratch", .format = settings.moments.format, .width = size_px, .height = rows}, {}));
        const auto scratch_target = keep(device().create_target({"scratch", {{scratch}}, {}}));
        const std::uint32_t layers = gl::layer_count(map);
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            frame.fitted.views.push_back(view_of(kind, layer, range));
            shadow::MapAssignment assigned;
            assigned.texture = depths;
            assigned.prefiltered.moments = moments;
            assigned.prefiltered.target = keep(device().create_target({"moments", {{moments, static_cast<std::int32_t>(layer)}}, {}}));
            if (settings.filtering.size > 1) {
                assigned.prefiltered.scratch = scratch;
                assigned.prefiltered.scratch_target = scratch_target;
            }
            assigned.size_px = size_px;
            frame.maps.push_back(assigned);
            frame.updates.emplace_back().convert = true;
        }
        frame.fitted.lights.resize(1);
        frame.fitted.lights[0].views.count = layers;
        auto gpu = GpuScene::create(device(), {});
        EXPECT_TRUE(gpu);
        const shadow::DrawnViews drawn = shadow::drawn_views(frame);
        const shadow::PassInputs in{scene, gpu.value(), drawn};
        shadow::PrefilterPass recorder(device());
        recorder.prepare(in, {frame.statuses, {}});
        gl::CommandList list;
        FrameReport report;
        recorder.record(in, {list, report, {}});
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
        view.depth.near_m = range.near_m;
        view.depth.far_m = range.far_m;
        view.depth.alpha = -range.near_m / (range.far_m - range.near_m);
        view.depth.beta = range.near_m * range.far_m / (range.far_m - range.near_m);
        return view;
    }
};

}  // namespace gnomon
