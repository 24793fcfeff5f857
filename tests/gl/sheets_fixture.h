#pragma once
#include <glm/geometric.hpp>

#include "shaders/embedded.h"
#include "systems/shadow/exact/sheet_recorder.h"
#include "systems/shadow/filter_table.h"
#include "systems/shadow/kinds/orthographic_view.h"
#include "systems/shadow/kinds/perspective_view.h"
#include "systems/shadow/light_kinds.h"
#include "systems/shadow/publish.h"
#include "systems/shadow/record.h"
#include "tests/gl/gl_test_context.h"
#include "tests/gl/sheet_worlds.h"

namespace gnomon {

enum class Verdict : std::uint8_t { lit, dark, uncertain };

/// All faces around a lamp.
inline std::vector<shadow::ShadowView> cube_views(const LightItem& light, const shadow::PerspectiveRange& range,
                                                  std::uint32_t size_px) {
    std::vector<shadow::ShadowView> views;
    const glm::dmat3 turn = glm::mat3_cast(shadow::cube_turn());
    for (std::uint32_t face = 0; face < 6; ++face) {
        const shadow::CubeFace& axes = shadow::cube_face(face);
        const glm::dmat3 turned = turn * glm::dmat3(axes.axis_u, axes.axis_v, axes.axis_back);
        views.push_back(
            shadow::perspective_view(light.position_ws_m, turned, shadow::TangentRectangle{}, range, size_px));
        views.back().projection = shadow::ViewProjection::cube_face;
        views.back().layer = face;
    }
    return views;
}

/// Sheets of views put together by hand, and what they say of places, by the shaders' own text.
class SheetsTest : public GlTest {
protected:
    struct Maps {
        gl::TextureHandle depths, triangles, second, bounds;
    };
    /// One light with its views, before and after its maps are drawn.
    struct Drawn {
        shadow::ShadowFrame frame;
        Maps maps;
    };

    /// Draws all casters of `scene` into `views`, which are of its only light.
    Drawn draw(const SceneSnapshot& scene, const assets::MeshLibrary& library, std::vector<shadow::ShadowView> views,
               std::uint32_t size_px, bool margins) {
        auto made = GpuScene::create(device(), library);
        EXPECT_TRUE(made);
        GpuScene gpu = std::move(made).value();
        gl::CommandList list;
        SceneSnapshot uploaded = scene;
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) uploaded.changed_instances.push_back(i);
        EXPECT_TRUE(gpu.update(uploaded, list));
        Drawn drawn;
        shadow::ShadowFrame& frame = drawn.frame;
        const LightItem& light = scene.lights.at(0);
        shadow::ShadowDemand demand;
        demand.filter = ShadowFilter::triangles;
        demand.filtering = shadow::filter_demand(shadow::filter_row(demand.filter), light.shadow, size_px);
        demand.resolution_px = demand.most_px = size_px;
        demand.view_count = static_cast<std::uint32_t>(views.size());
        frame.demands = {demand};
        frame.sets.resize(1);
        frame.cpu_us.resize(1);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].casts) frame.view_caster_items.push_back(i);
        frame.views = std::move(views);
        const bool cube = light.kind == LightKind::point;
        const auto layers = static_cast<std::uint32_t>(frame.views.size());
        const auto texture = [&](const char* label, gl::Format format, bool as_cube, std::uint32_t count) {
            return device()
                .create_texture({.label = label,
                                 .kind = as_cube ? gl::TextureKind::cube : gl::TextureKind::array,
                                 .format = format,
                                 .width = size_px,
                                 .height = size_px,
                                 .layers = as_cube ? 1u : count},
                                {})
                .handle;
        };
        drawn.maps = {
            texture("depths", gl::Format::d32f, cube, layers), texture("triangles", gl::Format::rg32ui, false, 1),
            texture("second", gl::Format::d32f, false, layers), texture("bounds", gl::Format::rg32f, false, layers)};
        for (std::uint32_t v = 0; v < layers; ++v) {
            shadow::ShadowView& view = frame.views[v];
            view.casters = {0, static_cast<std::uint32_t>(frame.view_caster_items.size())};
            view.still_casters = view.casters.count;
            const auto layer = static_cast<std::int32_t>(view.layer);
            shadow::ShadowSlot slot;
            slot.texture = drawn.maps.depths;
            slot.triangles = drawn.maps.triangles;
            slot.second = drawn.maps.second;
            slot.bounds = drawn.maps.bounds;
            slot.target =
                device().create_target({"first", {{drawn.maps.triangles, 0}}, {drawn.maps.depths, layer}}).handle;
            slot.second_target = device().create_target({"second", {}, {drawn.maps.second, layer}}).handle;
            slot.bounds_target = device().create_target({"bounds", {{drawn.maps.bounds, layer}}, {}}).handle;
            slot.size_px = size_px;
            frame.slots.push_back(slot);
        }
        shadow::DepthRecorder depths(device());
        shadow::SheetRecorder sheets(device(), margins);
        FrameReport report;
        report.lights.resize(1);
        depths.prepare(scene, gpu, frame);
        sheets.prepare(scene, gpu, frame);
        EXPECT_EQ(frame.sets[0].skip, Reason::none);
        shadow::publish_lights(scene, {}, {}, frame);
        depths.record(scene, gpu, frame, list, report);
        sheets.record(scene, gpu, frame, list, report);
        run(list);
        return drawn;
    }

    void discard(const Drawn& drawn) {
        for (const shadow::ShadowSlot& slot : drawn.frame.slots)
            for (const gl::TargetHandle target : {slot.target, slot.second_target, slot.bounds_target})
                device().destroy(target);
        const Maps& maps = drawn.maps;
        for (const gl::TextureHandle map : {maps.depths, maps.triangles, maps.second, maps.bounds})
            device().destroy(map);
    }

    /// Of places relative to the scene's first consumer, each with how far off it may be.
    std::vector<Verdict> verdicts(const Drawn& drawn, LightKind kind, const std::vector<glm::vec4>& places_ca,
                                  bool receivers_cast, bool margins) {
        constexpr std::uint32_t kRow = 256;
        const auto rows = static_cast<std::uint32_t>((places_ca.size() + kRow - 1) / kRow);
        std::vector<glm::vec4> padded = places_ca;
        padded.resize(std::size_t{rows} * kRow);
        const auto bytes = std::as_bytes(std::span(padded));
        const auto buffer =
            device()
                .create_buffer({.label = "places", .size = bytes.size(), .use = gl::BufferUse::fixed}, bytes)
                .handle;
        const auto& record = drawn.frame.inputs.at(0).lights.at(0).record;
        const auto block = device()
                               .create_buffer({.label = "light", .size = sizeof record, .use = gl::BufferUse::fixed},
                                              std::as_bytes(std::span(&record, 1)))
                               .handle;
        const auto out =
            device()
                .create_texture({.label = "verdicts", .format = gl::Format::r32f, .width = kRow, .height = rows}, {})
                .handle;
        const auto target = device().create_target({"verdicts", {{out}}, {}}).handle;
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target,
                               .viewport = {0, 0, static_cast<std::int32_t>(kRow), static_cast<std::int32_t>(rows)}});
        list.add(gl::SetPipeline{{.program = verdict_program(kind, receivers_cast, margins)}});
        list.add(gl::BindUniforms{1, block, 0, sizeof record});
        list.add(gl::BindStorage{9, buffer});
        list.add(gl::BindTexture{4, drawn.maps.depths, {}});
        list.add(gl::BindTexture{7, drawn.maps.second, {}});
        list.add(gl::BindTexture{8, drawn.maps.bounds, {}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        const auto values = read<float>(out, padded.size());
        device().destroy(target);
        device().destroy(out);
        device().destroy(block);
        device().destroy(buffer);
        std::vector<Verdict> verdicts;
        for (std::size_t i = 0; i < places_ca.size(); ++i)
            verdicts.push_back(static_cast<Verdict>(static_cast<int>(values[i])));
        return verdicts;
    }

private:
    gl::ProgramHandle verdict_program(LightKind kind, bool receivers_cast, bool margins) {
        gl::ProgramHandle& program = programs_[static_cast<std::size_t>(kind)][receivers_cast ? 1 : 0][margins ? 1 : 0];
        if (program) return program;
        const auto& row = shadow::light_kind_row(kind);
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        const std::string text =
            "#include \"" + std::string(row.file) +
            "\"\n#include \"shadow/exact/verdict.glsl\"\n"
            "layout(std430, binding = 9) readonly buffer Places { vec4 places[]; };\n"
            "layout(location = 0) out float verdict;\n"
            "void main() {\n"
            "    vec4 place = places[int(gl_FragCoord.y) * 256 + int(gl_FragCoord.x)];\n"
            "    ShadowPoint point = shadow_point(0, place.xyz, vec3(0.0, 1.0, 0.0), place.w, 0.0);\n"
            "    verdict = float(sheet_verdict(point, place.xyz, place.w, " +
            (receivers_cast ? "true" : "false") + "));\n}\n";
        files.push_back({"verdict.frag", text});
        std::vector<std::string> defines{"SHADOWED 1", "SHADOW_DEPTHS 1", "SHADOW_REACH_TEXEL 0.0",
                                         std::string(row.define) + " 1"};
        if (!margins) defines.emplace_back("SHEETS_WITHOUT_MARGINS 1");
        const auto vertex = gl::expand_shader(files, "shared/fullscreen.vert", defines);
        const auto fragment = gl::expand_shader(files, "verdict.frag", defines);
        EXPECT_TRUE(vertex && fragment);
        if (!vertex || !fragment) return {};
        return program = keep(device().create_program({"verdict", vertex.value(), fragment.value()}));
    }
    gl::ProgramHandle programs_[3][2][2]{};
};

}  // namespace gnomon
