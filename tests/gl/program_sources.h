#pragma once
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/gl/device_recording.h"
#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "systems/debug/debug_view.h"
#include "systems/extract/light_facts.h"
#include "systems/lighting/light_programs.h"
#include "systems/shadow/passes/prefilter_pass.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon {

inline bool reads_depths(const shadow::FilterRow& filter) { return filter.reading == shadow::MapReading::depths; }

inline bool reads_triangles(const shadow::FilterRow& filter) { return filter.storage.triangle_ids; }

inline bool reads_moments(const shadow::FilterRow& filter) { return filter.moments; }

/// Returns the filters that read a map, and nothing else.
inline std::vector<shadow::FilterRow> map_filters() {
    std::vector<shadow::FilterRow> rows;
    for (const shadow::FilterRow& row : shadow::filter_table())
        if (!row.rays) rows.push_back(row);
    return rows;
}

/// Returns whether a define is that of an area light.
inline bool is_area(std::string_view define) {
    const auto rows = shadow::light_kind_table();
    return std::any_of(rows.begin(), rows.end(),
                       [&](const shadow::LightKindRow& row) { return row.define == define && light_facts(row.kind).area(); });
}

/// Returns whether the row of an area light and a filter is compiled. Filters that see the middle alone look it up as a
/// point. Kinds share all but their places: pcss and rays show these, rectangles stand for the rest.
inline bool is_area_row(LightKind kind, const shadow::FilterRow& filter) {
    const bool sees_source = filter.width == shadow::FilterWidth::source;
    if (filter.rays) return sees_source;
    return kind == LightKind::rectangle ? sees_source || filter.id == ShadowFilter::hard : filter.id == ShadowFilter::pcss;
}

/// Returns every row of (light kind × filter), with and without fading or a manual bias, and each kind unshadowed. Suns
/// and points have rows in perspective, suns also warped ones. Filters by triangles have rows with masked casters,
/// prefiltered ones rows by a pixel's footprint. Filters by rays have rows with and without masked casters and maps.
inline std::vector<shadow::ShaderKey> all_rows() {
    std::vector<shadow::ShaderKey> rows;
    for (const shadow::LightKindRow& kind : shadow::light_kind_table()) {
        rows.push_back({kind.define, {}, {}});
        if (light_facts(kind.kind).area()) {
            for (const shadow::FilterRow& filter : map_filters())
                if (is_area_row(kind.kind, filter))
                    rows.push_back({kind.define, kind.file, filter.file, filter.reach_texel, false, reads_depths(filter)});
            continue;
        }
        for (const shadow::FilterRow& filter : map_filters())
            for (const bool fades : {false, true})
                if (!fades || kind.texture != gl::TextureKind::cube)  // a cube has nothing to fade into
                    rows.push_back(
                        {kind.define, kind.file, filter.file, filter.reach_texel, fades, reads_depths(filter)});
        for (const shadow::FilterRow& filter : map_filters())
            rows.push_back(
                {kind.define, kind.file, filter.file, filter.reach_texel, false, reads_depths(filter), true});
    }
    const shadow::LightKindRow &sun = shadow::light_kind_row(LightKind::directional),
                               &point = shadow::light_kind_row(LightKind::point);
    for (const shadow::FilterRow& filter : map_filters())
        for (const shadow::LightKindRow* kind : {&sun, &point})
            rows.push_back(
                {kind->define, shadow::kPerspectiveFile, filter.file, filter.reach_texel, false, reads_depths(filter)});
    for (const shadow::FilterRow& filter : map_filters())
        for (const bool fades : {false, true})
            rows.push_back(
                {sun.define, shadow::kWarpedSunFile, filter.file, filter.reach_texel, fades, reads_depths(filter)});
    for (shadow::ShaderKey& row : rows)
        for (const shadow::FilterRow& filter : shadow::filter_table()) {
            if (filter.file != row.filter_file) continue;
            row.triangles = reads_triangles(filter);
            row.moments = reads_moments(filter);
            row.whole_source = is_area(row.kind_define) && filter.width == shadow::FilterWidth::source;
        }
    const std::size_t plain = rows.size();
    for (std::size_t i = 0; i < plain; ++i)
        if (rows[i].triangles) {
            rows.push_back(rows[i]);
            rows.back().ray_masks = true;
        }
    for (std::size_t i = 0; i < plain; ++i)
        if (rows[i].moments) {
            rows.push_back(rows[i]);
            rows.back().footprint = true;
        }
    for (const shadow::LightKindRow& kind : shadow::light_kind_table())
        for (const shadow::FilterRow& filter : shadow::filter_table())
            for (const bool masks : {false, true})
                for (const bool sheets : {false, true})
                    if (filter.rays && (!light_facts(kind.kind).area() || (is_area_row(kind.kind, filter) && !masks))) {
                        rows.push_back({.kind_define = kind.define,
                                        .kind_file = kind.file,
                                        .filter_file = filter.file,
                                        .depths = sheets,
                                        .sheets = sheets,
                                        .rays = true,
                                        .ray_masks = masks,
                                        .whole_source = is_area(kind.define) && filter.width == shadow::FilterWidth::source});
                        if (kind.kind != LightKind::point) continue;
                        rows.push_back(rows.back());
                        rows.back().kind_file = shadow::kPerspectiveFile;
                    }
    return rows;
}

/// Returns the rows with different lookups: the first filter of every way to read a map, for all kinds and options.
/// "bias" gets all of them, since it needs most of a lookup; other views get one per kind.
inline std::vector<shadow::ShaderKey> lookup_rows(std::string_view view) {
    std::vector<shadow::ShaderKey> kept, known;
    for (const shadow::ShaderKey& row : all_rows()) {
        if (row.filter_file.empty() || row.rays) continue;
        shadow::ShaderKey rest = row;
        rest.filter_file = {};
        rest.reach_texel = 0.0f;
        if (view != "bias") rest = {.kind_define = {}, .kind_file = row.kind_file, .filter_file = {}};
        if (std::find(known.begin(), known.end(), rest) != known.end()) continue;
        known.push_back(rest);
        kept.push_back(row);
    }
    return kept;
}

/// Returns the sources of every program. The lighting system's are as it hands them to a device. The depth programs',
/// those of prefiltered maps and those of debug views follow.
inline std::vector<gl::ProgramDesc> all_programs() {
    std::vector<gl::ProgramDesc> programs;
    gl::RecordingDevice device;
    {
        lighting::LightPrograms lighting(device);
        const auto add = [&](gl::ProgramHandle handle) {
            if (const gl::ProgramDesc* desc = device.program(handle))
                programs.push_back(*desc);
            else
                programs.push_back({.label = "not expanded"});
        };
        for (const bool coloured : {false, true}) {
            lighting.set_coloured(coloured);
            add(lighting.surface());
            add(lighting.surface(true));
            add(lighting.blended_base());
            add(lighting.unlit_surface(false));
            add(lighting.unlit_surface(true));
            add(lighting.unlit_blended());
            add(lighting.catcher_base());
        }
        lighting.set_coloured(false);
        add(lighting.luminance());
        add(lighting.catcher_shares());
        add(lighting.fog_base());
        for (const bool transparent : {false, true}) add(lighting.tonemap(transparent));
        // Rows with sheets share programs.
        std::set<std::uint32_t> shared;
        for (const shadow::ShaderKey& row : all_rows()) {
            using enum lighting::ShaderPass;
            for (const auto output : {picture, visibility, blended, catcher, verdicts, rays, fog}) {
                if (!row.sheets && (output == verdicts || output == rays)) continue;
                const gl::ProgramHandle program = lighting.row(row, output);
                if (!row.sheets || shared.insert(program.id).second) add(program);
            }
        }
        for (const debug::ViewRow& view : debug::view_table())
            if (view.drawer->medium == debug::ViewMedium::lookups)
                for (const shadow::ShaderKey& row : lookup_rows(view.name))
                    add(lighting.lookups(row, view.drawer->fragment));
    }
    {
        using Source = shadow::PrefilterPass::Source;
        shadow::PrefilterPass moments(device);
        const auto add = [&](std::string_view file, Source source) {
            const gl::ProgramDesc* desc = device.program(moments.program(file, source));
            programs.push_back(desc ? *desc : gl::ProgramDesc{.label = "not expanded"});
        };
        add({}, Source::scratch);
        for (const shadow::FilterRow& filter : shadow::filter_table())
            for (const Source source : {Source::orthographic, Source::perspective, Source::cube})
                if (reads_moments(filter)) add(filter.file, source);
    }
    for (const int kind : {0, 1, 2, 3, 5, 7}) {
        const bool masked = kind % 2 != 0, triangles = (kind & 2) != 0, coloured = kind >= 4;
        std::vector<std::string> defines;
        if (masked) defines.emplace_back("MASKED 1");
        if (triangles) defines.emplace_back("TRIANGLES 1");
        if (coloured) defines.emplace_back("COLOURED 1");
        const auto vertex = gl::expand_shader(shader_files(), "shadow/passes/depth/depth.vert", defines);
        const auto fragment = gl::expand_shader(shader_files(), "shadow/passes/depth/depth.frag", defines);
        if (vertex && fragment)
            programs.push_back({std::string(masked ? "depth masked" : "depth opaque") +
                                    (triangles ? ", triangles" : "") + (coloured ? ", coloured" : ""),
                                vertex.value(), fragment.value()});
    }
    for (const char* file : {"lighting/post/depth_histogram.comp", "lighting/post/exposure.comp"})
        if (const auto compute = gl::expand_shader(shader_files(), file, {}))
            programs.push_back({.label = file, .compute = compute.value()});
    for (const char* define : {"", "CUBE 1", "OF_LEVEL 1"}) {
        const std::vector<std::string> defines(*define ? 1 : 0, define);
        if (const auto compute =
                gl::expand_shader(shader_files(), "shadow/passes/bounds/occluder_pyramid.comp", defines))
            programs.push_back({.label = std::string("ends ") + define, .compute = compute.value()});
    }
    const auto add_view = [&](std::string_view vertex_file, std::string_view fragment_file) {
        const auto vertex = gl::expand_shader(shader_files(), vertex_file, {});
        const auto fragment = gl::expand_shader(shader_files(), fragment_file, {});
        if (vertex && fragment) programs.push_back({std::string(fragment_file), vertex.value(), fragment.value()});
    };
    add_view("debug/lines.vert", "debug/lines.frag");
    for (const debug::ViewRow& view : debug::view_table())
        if (view.drawer->medium == debug::ViewMedium::flat) add_view("common/fullscreen.vert", view.drawer->fragment);
    return programs;
}

}  // namespace gnomon
