#pragma once
#include <algorithm>
#include <glm/geometric.hpp>

#include "shaders/embedded.h"
#include "systems/shadow/exact/bounds_pass.h"
#include "systems/shadow/exact/near_light_clearance.h"
#include "systems/shadow/exact/occluder_pyramid_pass.h"
#include "systems/shadow/passes/depth_pass.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/shadow/request/filter_settings.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/gl/gl_test_context.h"

namespace gnomon {

inline constexpr double kUnitRoundoff = 5.9604644775390625e-8;  // 2^-24, of a float

/// Most worlds that are played for each planned one. A few worlds may happen to leave nearly all places to rays.
inline constexpr int kMostPerPlanned = 8;

enum class Verdict : std::uint8_t { lit, dark, uncertain };

/// Sheets of views put together by hand, and their verdicts on places, by the shaders' own text.
class SheetsTest : public GlTest {
protected:
    struct Maps {
        gl::TextureHandle depths, triangles, second, bounds;
        gl::BufferHandle ends;
    };
    /// Query of the maps. `middle`: verdict as the light's middle sees a place. `source`: as all of its source does.
    /// `source_without_reach`: the same without looking beside the middle. `reach`: how far toward the middle anything
    /// may stand.
    enum class Ask : std::uint8_t { middle, source, source_without_reach, reach, count };
    /// One light with its views, before and after its maps are drawn.
    struct Drawn {
        shadow::ShadowFrame frame;
        Maps maps;
        std::size_t points = 0;  // draws of them
    };

    /// Draws all casters of `scene` into `views`, which are of its only light.
    Drawn draw(const SceneSnapshot& scene, const assets::MeshLibrary& library, std::vector<shadow::ShadowView> views,
               std::uint32_t size_px, bool margins, Ask ask = Ask::middle, bool points = true) {
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
        frame.decisions.resize(1);
        shadow::ShadowRequest& request = frame.decisions[0].request;
        shadow::MapSettings& map = request.map;
        map.filter = ask == Ask::middle ? ShadowFilter::triangles : ShadowFilter::exact_soft;
        map.filtering = shadow::filter_settings(shadow::filter_row(map.filter), light, size_px);
        map.resolution_px = request.limits.max_px = size_px;
        map.view_count = static_cast<std::uint32_t>(views.size());
        frame.statuses.resize(1);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].casts) frame.fitted.casters.push_back(i);
        frame.fitted.views = std::move(views);
        frame.fitted.lights.resize(1);
        frame.fitted.lights[0].views.count = map.view_count;
        frame.updates.resize(frame.fitted.views.size());
        const bool cube = light.kind == LightKind::point;
        const auto layers = static_cast<std::uint32_t>(frame.fitted.views.size());
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
        drawn.maps = {texture("depths", gl::Format::d32f, cube, layers),
                      texture("triangles", gl::Format::rg32ui, false, 1),
                      texture("second", gl::Format::d32f, false, layers),
                      texture("bounds", gl::Format::rg32f, false, layers),
                      {}};
        if (ask != Ask::middle)
            drawn.maps.ends =
                device().create_buffer({.label = "ends", .size = shadow::pyramid_bytes(size_px, layers)}, {}).handle;
        for (std::uint32_t v = 0; v < layers; ++v) {
            shadow::ShadowView& view = frame.fitted.views[v];
            view.casters = {0, static_cast<std::uint32_t>(frame.fitted.casters.size())};
            view.static_casters = view.casters.count;
            const auto layer = static_cast<std::int32_t>(view.layer);
            shadow::MapAssignment assigned;
            assigned.texture = drawn.maps.depths;
            assigned.triangles = drawn.maps.triangles;
            assigned.target =
                device().create_target({"first", {{drawn.maps.triangles, 0}}, {drawn.maps.depths, layer}}).handle;
            assigned.sheets = {drawn.maps.second,
                               device().create_target({"second", {}, {drawn.maps.second, layer}}).handle,
                               drawn.maps.bounds,
                               device().create_target({"bounds", {{drawn.maps.bounds, layer}}, {}}).handle,
                               drawn.maps.ends};
            assigned.size_px = size_px;
            frame.maps.push_back(assigned);
        }
        shadow::DepthPass depths(device());
        shadow::BoundsPass sheets(device(), {.with_margins = margins, .with_points = points});
        shadow::OccluderPyramidPass ends(device(), margins);
        FrameReport report;
        report.lights.resize(1);
        const shadow::DrawnViews drawn_views = shadow::drawn_views(frame);
        const shadow::PassInputs in{scene, gpu, drawn_views};
        const shadow::PassOutputs out{list, report, {}};
        const shadow::LightAccounts accounts{frame.statuses, {}};
        depths.prepare(in, accounts);
        sheets.prepare(in, accounts);
        ends.prepare(in, accounts);
        shadow::measure_clearances(in, frame.clearances_m, {});
        EXPECT_FALSE(frame.statuses[0].is_skipped());
        EXPECT_FALSE(frame.statuses[0].has_lost_maps());
        const shadow::MapSamplers samplers;
        const visibility::RayBuffers no_rays;
        shadow::publish_lights(scene, {drawn_views, {}, frame.clearances_m, samplers, no_rays}, frame.inputs, {});
        depths.record(in, out);
        sheets.record(in, out);
        drawn.points = static_cast<std::size_t>(
            std::count_if(list.commands.begin(), list.commands.end(),
                          [](const gl::Command& c) { return std::holds_alternative<gl::DrawPoints>(c); }));
        ends.record(in, out);
        run(list);
        return drawn;
    }

    void discard(const Drawn& drawn) {
        for (const shadow::MapAssignment& map : drawn.frame.maps)
            for (const gl::TargetHandle target : {map.target, map.sheets.second_target, map.sheets.bounds_target})
                device().destroy(target);
        const Maps& maps = drawn.maps;
        for (const gl::TextureHandle map : {maps.depths, maps.triangles, maps.second, maps.bounds})
            device().destroy(map);
        device().destroy(maps.ends);
    }

    /// Returns the verdicts on places relative to the scene's first consumer. w: how far off the place may be, m.
    std::vector<Verdict> verdicts(const Drawn& drawn, LightKind kind, const std::vector<glm::vec4>& places_ca,
                                  bool receivers_cast, bool margins, Ask ask = Ask::middle) {
        std::vector<Verdict> verdicts;
        for (const float value : asked(drawn, kind, places_ca, receivers_cast, margins, ask))
            verdicts.push_back(static_cast<Verdict>(static_cast<int>(value)));
        return verdicts;
    }

    /// Returns sheet_reach() of such places: metres toward a sun, share of the way to a lamp.
    std::vector<float> reaches(const Drawn& drawn, LightKind kind, const std::vector<glm::vec4>& places_ca,
                               bool margins) {
        return asked(drawn, kind, places_ca, true, margins, Ask::reach);
    }

private:
    std::vector<float> asked(const Drawn& drawn, LightKind kind, const std::vector<glm::vec4>& places_ca,
                             bool receivers_cast, bool margins, Ask ask) {
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
        list.add(gl::SetPipeline{{.program = verdict_program(kind, receivers_cast, margins, ask)}});
        list.add(gl::BindUniforms{1, block, 0, sizeof record});
        list.add(gl::BindStorage{9, buffer});
        list.add(gl::BindTexture{4, drawn.maps.depths, {}});
        list.add(gl::BindTexture{7, drawn.maps.second, {}});
        list.add(gl::BindTexture{8, drawn.maps.bounds, {}});
        if (drawn.maps.ends) list.add(gl::BindStorage{2, drawn.maps.ends});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        auto values = read<float>(out, padded.size());
        device().destroy(target);
        device().destroy(out);
        device().destroy(block);
        device().destroy(buffer);
        values.resize(places_ca.size());
        return values;
    }

    static bool is_of_source(Ask ask) { return ask == Ask::source || ask == Ask::source_without_reach; }

    gl::ProgramHandle verdict_program(LightKind kind, bool receivers_cast, bool margins, Ask ask) {
        gl::ProgramHandle& program = programs_[static_cast<std::size_t>(kind)][receivers_cast ? 1 : 0][margins ? 1 : 0]
                                              [static_cast<std::size_t>(ask)];
        if (program) return program;
        const auto& row = shadow::light_kind_row(kind);
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        const std::string text =
            "#include \"" + std::string(row.file) + "\"\n#include \"shadow/filters/exact/classify.glsl\"\n" +
            (is_of_source(ask) ? "#include \"shadow/filters/exact/classify_soft.glsl\"\n" : "") +
            "layout(std430, binding = 9) readonly buffer Places { vec4 places[]; };\n"
            "layout(location = 0) out float verdict;\n"
            "void main() {\n"
            "    vec4 place = places[int(gl_FragCoord.y) * 256 + int(gl_FragCoord.x)];\n"
            "    SheetPlace at = sheet_place(place.xyz, place.w);\n"
            "    verdict = float(" +
            (ask == Ask::reach
                 ? "sheet_reach(at"
                 : std::string(is_of_source(ask) ? "soft_verdict(at, place.xyz, " : "sheet_verdict(at, ") +
                       (receivers_cast ? "true" : "false")) +
            "));\n}\n";
        files.push_back({"verdict.frag", text});
        std::vector<std::string> defines = shadow::program_defines(
            {.kind_define = row.define, .kind_file = row.file, .filter_file = {}, .depths = true});
        if (!margins) defines.emplace_back("SHEETS_WITHOUT_MARGINS 1");
        if (ask == Ask::source_without_reach) defines.emplace_back("SHEETS_WITHOUT_REACH 1");
        const auto vertex = gl::expand_shader(files, "common/fullscreen.vert", defines);
        const auto fragment = gl::expand_shader(files, "verdict.frag", defines);
        EXPECT_TRUE(vertex && fragment);
        if (!vertex || !fragment) return {};
        return program = keep(device().create_program({"verdict", vertex.value(), fragment.value()}));
    }
    gl::ProgramHandle programs_[3][2][2][static_cast<std::size_t>(Ask::count)]{};
};

}  // namespace gnomon
