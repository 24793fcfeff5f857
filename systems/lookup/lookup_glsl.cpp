#include "systems/lookup/lookup_glsl.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/glsl_library.h"
#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "systems/lookup/lookup_record.h"
#include "systems/lookup/lookup_templates.h"
#include "systems/shadow/frame/shared_defines.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::lookup {
namespace {

using shadow::FilterRow;
using shadow::MapReading;
using Names = std::set<std::string, std::less<>>;

constexpr std::array kFlatKinds = {LookupKind::cascades, LookupKind::warped_cascades, LookupKind::cone};

/// Returns what stands in the place of names of the shaders of one light: the light's record, its row's flags, and
/// what reads its map.
const std::map<std::string, std::string, std::less<>>& replaced_names() {
    static const std::map<std::string, std::string, std::less<>> kReplaced = {
        {"light", "gnomon_light"},
        {"camera", "gnomon_camera"},
        {"kIsSun", "gnomon_is_sun"},
        {"kIsSpot", "gnomon_is_spot"},
        {"kReadsDepths", "gnomon_reads_depths"},
        {"kReadsTaps", "(!gnomon_reads_depths)"},
        {"kReadsMoments", "false"},
        {"kFootprint", "false"},
        {"kFades", "true"},
        {"kManualBias", "true"},
        {"kAsksRays", "false"},
        {"map_edge_px", "gnomon_map_edge_px"},
        {"shared_depth", "gnomon_shared_depth"},
        {"shared_depths", "gnomon_shared_depths"},
        {"shared_id", "gnomon_shared_id"},
        {"shared_ids", "gnomon_shared_ids"},
        {"caster_triangles", "gnomon_caster_triangles"},
        {"instance_texels", "gnomon_instance_texels"},
        {"ray_masks", "gnomon_ray_masks"},
        {"gl_FragCoord", "gnomon_pixel"},
    };
    return kReplaced;
}

using Values = std::map<std::string, std::string, std::less<>>;

/// Adds the shaders of one row to a library.
Result<gl::GlslNames> add_row(gl::GlslLibrary& library, std::string_view kind_file, const FilterRow& filter,
                              const LookupRows& rows) {
    std::string text = "#include \"common/camera_block.glsl\"\n#include \"lighting/lights/light_sample.glsl\"\n";
    for (const std::string_view file : {kind_file, filter.file, std::string_view("shadow/lookup/light_vector.glsl"),
                                        std::string_view("shadow/lookup/shadow_layers.glsl")})
        text.append("#include \"").append(file).append("\"\n");
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", text});
    const std::vector<std::string> defines =
        shadow::shared_defines({filter.reading == MapReading::compare_linear, rows.masks, rows.antialias, "gnomon_reach_texel"});
    const auto expanded = gl::expand_shader(files, "row.glsl", defines);
    if (!expanded) return expanded.error();
    return library.add(expanded.value());
}

/// Names of the functions that one text calls.
struct RowNames {
    std::array<gl::GlslNames, 4> kinds;   // by LookupKind, from cascades on
    std::vector<std::string> flat, cube;  // shadow_filter() by filter

    const std::string& of(LookupKind kind, const char* name) const {
        return kinds[static_cast<std::size_t>(kind) - 1].find(name)->second;
    }
};

/// Adds all rows to the library.
Result<RowNames> add_rows(gl::GlslLibrary& library, const LookupRows& rows) {
    RowNames found;
    const std::array<std::string_view, 4> files = {kCascadesFile, shadow::kWarpedSunFile, shadow::kPerspectiveFile,
                                                   kCubeFile};
    for (std::size_t i = 0; i < files.size(); ++i) {
        auto names = add_row(library, files[i], shadow::filter_row(rows.filters.front()), rows);
        if (!names) return names.error();
        found.kinds[i] = std::move(names).value();
    }
    for (const ShadowFilter filter : rows.filters)
        for (const bool cube : {false, true}) {
            const std::string_view file = cube ? kCubeFile : shadow::kPerspectiveFile;
            const auto names = add_row(library, file, shadow::filter_row(filter), rows);
            if (!names) return names.error();
            (cube ? found.cube : found.flat).push_back(names.value().at("shadow_filter"));
        }
    return found;
}

/// Returns a template's text with its values, each in the place of its $name$.
std::string filled(std::string_view text, const Values& values) {
    std::string out;
    while (!text.empty()) {
        const std::size_t open = text.find('$');
        out.append(text.substr(0, open));
        if (open == std::string_view::npos) break;
        const std::size_t close = text.find('$', open + 1);
        const auto value = values.find(text.substr(open + 1, close - open - 1));
        if (value != values.end()) out.append(value->second);
        text.remove_prefix(close + 1);
    }
    return out;
}

/// Appends a statement that runs only if `condition` holds.
void add_if(const std::string& condition, const std::string& statement, std::string& text) {
    text.append("    if (").append(condition).append(") ").append(statement).append("\n");
}

/// Members of a block, and the text that reads them one after the other.
struct BlockText {
    std::string members, loads;
    std::uint32_t texels = 0;
};

/// Returns it for a block's members before its first array. `at`: the texel of the first, in GLSL.
BlockText block_text(std::span<const gl::GlslLibrary::Member> members, const std::string& at) {
    BlockText text;
    for (const auto& member : members) {
        if (member.is_array) break;
        text.members.append("    ").append(member.type).append(" ").append(member.name).append(";\n");
        const bool matrix = member.type == "mat4";
        text.loads.append(text.loads.empty() ? "" : ", ");
        text.loads.append(matrix ? "gnomon_matrix(" : member.type == "ivec4" ? "gnomon_ints(" : "gnomon_floats(");
        text.loads.append(at).append(" + ").append(std::to_string(text.texels)).append(")");
        text.texels += matrix ? 4 : 1;
    }
    return text;
}

Error refused(const char* rule, std::string what) { return {std::move(what), {}, {}, rule}; }

std::string filter_calls(const std::vector<std::string>& filters, Names& roots) {
    std::string text;
    for (std::size_t i = 0; i < filters.size(); ++i)
        add_if("row.y == " + std::to_string(i), "found = " + filters[i] + "(point);", text);
    roots.insert(filters.begin(), filters.end());
    return text;
}

/// Returns the names that a template calls, of one kind. Adds them to `roots`.
Values called_names(const RowNames& names, LookupKind kind, Names& roots) {
    Values values;
    for (const auto& [key, name] : {std::pair("point", "ShadowPoint"),
                                    {"may_be_dark", "may_be_dark"},
                                    {"on_plane", "compares_on_plane"},
                                    {"move", "on_receiver_plane"},
                                    {"slope", "shadow_slope"},
                                    {"shadow_point", "shadow_point"},
                                    {"takes_shadow", "takes_shadow"},
                                    {"unreached", "is_unreached"},
                                    {"light_at", "light_at"},
                                    {"toward_light", "toward_light"}}) {
        values[key] = names.of(kind, name);
        roots.insert(values[key]);
    }
    return values;
}

/// Returns the function that looks up flat maps; empty if the text has no kind with one.
std::string flat_text(const RowNames& names, const LookupRows& rows, Names& roots) {
    std::string points, fades;
    for (const LookupKind kind : kFlatKinds) {
        if (!has_kind(rows, kind)) continue;
        const std::string is_kind = "row.x == " + std::to_string(static_cast<int>(kind));
        const std::string& point = names.of(kind, "shadow_point");
        add_if(is_kind, "point = " + point + "(lookup, position, normal, error_m, reach_texel);", points);
        const std::string &into = names.of(kind, "shadow_fades_into"), &share = names.of(kind, "shadow_fade_share");
        add_if(is_kind, "{ fades_into = " + into + "(point); next = " + share + "(point, reach_texel); }", fades);
        roots.insert({point, into, share});
    }
    if (points.empty()) return {};
    Values values = called_names(names, LookupKind::cone, roots);
    values["points"] = points;
    values["fades"] = fades;
    values["filters"] = filter_calls(names.flat, roots);
    return filled(kFlat, values);
}

/// Returns the function that looks up cubes; empty if the text has none.
std::string cube_text(const RowNames& names, const LookupRows& rows, Names& roots) {
    if (!rows.cubes) return {};
    Values values = called_names(names, LookupKind::cube, roots);
    values["filters"] = filter_calls(names.cube, roots);
    return filled(kCube, values);
}

/// Returns a statement for each of the shared arrays, with its number in the place of #, that runs for the array in use.
std::string in_each(std::string_view statement, std::uint32_t arrays) {
    std::string text;
    for (std::uint32_t i = 0; i < arrays; ++i) {
        const std::string number = std::to_string(i);
        std::string numbered;
        for (const char c : statement) c == '#' ? numbered.append(number) : numbered.append(1, c);
        add_if("gnomon_unit == " + number, numbered, text);
    }
    return text;
}

/// Returns the functions of one name that look lights up, by that statement.
std::string lookups_text(const char* name, std::string_view looked_up, Values values) {
    values["lookup"] = name;
    values["looked_up"] = looked_up;
    return filled(kLookups, values);
}

/// Returns the text that reads records and shared arrays.
std::string records_text(const gl::GlslLibrary& library, const RowNames& names, const LookupBindings& bindings,
                         bool for_hardware) {
    const LookupUnits units = units_of(bindings);
    const BlockText light = block_text(library.members("LightBlock"), "texel");
    const BlockText camera = block_text(library.members("CameraBlock"), "0");
    const Values values = {{"light", light.members},
                           {"camera", camera.members},
                           {"head_texels", std::to_string(camera.texels + 1)},
                           {"light_texels", std::to_string(sizeof(LookupRecord) / gl::kTexelBytes)},
                           {"records", std::to_string(units.first_texels)},
                           {"instances", std::to_string(units.first_texels + 1)},
                           {"triangles", std::to_string(units.first_texels + 2)},
                           {"masks", std::to_string(bindings.storage_binding)},
                           {"view", names.of(LookupKind::cone, "ViewRecord")},
                           {"members", std::to_string(light.texels)},
                           {"load_light", light.loads + ", "},
                           {"load_camera", camera.loads},
                           {"units", std::to_string(units.arrays)},
                           {"depths", std::to_string(units.first_depths)},
                           {"ids", std::to_string(units.first_triangles)},
                           {"four", names.of(LookupKind::cone, "FourTriangles")},
                           {"unpacked", names.of(LookupKind::cone, "unpacked_triangle")},
                           {"all_unpacked", names.of(LookupKind::cone, "unpacked_triangles")},
                           {"read_depth", in_each("depth = textureLod(gnomon_depths[#], place, 0.0).x;", units.arrays)},
                           {"read_id", in_each("id = textureLod(gnomon_ids[#], place, 0.0).xy;", units.arrays)},
                           {"gather_depths", in_each("depths = textureGather(gnomon_depths[#], place);", units.arrays)},
                           {"gather_ids", in_each("{ instances = textureGather(gnomon_ids[#], place, 0); "
                                                  "triangles = textureGather(gnomon_ids[#], place, 1); }",
                                                  units.arrays)}};
    return filled(kRecords, values) + filled(kArrays, values) +
           filled(for_hardware ? kHardwareReaders : kSoftwareReaders, values);
}

}  // namespace

Result<std::string> lookup_glsl(const LookupBindings& bindings, const LookupRows& rows) {
    if (bindings.texture_unit_count < kLeastTextureUnits)
        return refused("lookup.bindings", "lookups of all lights need " + std::to_string(kLeastTextureUnits) +
                                              " texture units at least (docs/reference/limits.md)");
    if (rows.filters.empty() || !std::all_of(rows.filters.begin(), rows.filters.end(), can_evaluate))
        return refused("lookup.rows", "lookups of all lights have filters that read depths alone");
    if (!rows.suns && !rows.warped_suns && !rows.cones && !rows.cubes)
        return refused("lookup.rows", "lookups of all lights need a kind of light");
    gl::GlslLibrary library("gnomon_", replaced_names());
    library.replace_elements("light", "views", "gnomon_view");
    const auto added = add_rows(library, rows);
    if (!added) return added.error();
    const RowNames& names = added.value();

    const Names first = {names.of(LookupKind::cone, "ViewRecord"), names.of(LookupKind::cone, "FourTriangles"),
                         names.of(LookupKind::cone, "unpacked_triangles")};
    Names roots;
    const std::string flat = flat_text(names, rows, roots), cube = cube_text(names, rows, roots);
    Values entries = called_names(names, flat.empty() ? LookupKind::cube : LookupKind::cone, roots);
    if (!cube.empty())
        add_if("gnomon_light.row.x == 4", "return gnomon_cube_visibility(position, normal, error_m);",
               entries["cubes"]);
    if (!flat.empty())
        add_if("gnomon_light.row.x > 0", "return gnomon_flat_visibility(position, normal, error_m);", entries["flats"]);
    return library.text(first) + records_text(library, names, bindings, rows.for_hardware) + library.text(roots, first) +
           flat + cube + filled(kEntries, entries) + lookups_text("gnomon_visibility", rows.for_hardware ? kLookUpAtOnce : kLookUpInRounds, entries) +
           lookups_text("gnomon_uniform_visibility", kLookUpAtOnce, entries);
}

}  // namespace gnomon::lookup
