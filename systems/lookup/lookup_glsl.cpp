#include "systems/lookup/lookup_glsl.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/gl/glsl_library.h"
#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "systems/lookup/lookup_record.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon::lookup {
namespace {

using shadow::FilterRow;
using shadow::MapReading;
using Names = std::set<std::string, std::less<>>;

constexpr std::string_view kCascadesFile = "shadow/lookup/kinds/directional.glsl";
constexpr std::string_view kCubeFile = "shadow/lookup/kinds/point.glsl";

constexpr std::array kUsualFilters = {ShadowFilter::triangles, ShadowFilter::pcss, ShadowFilter::pcf_bilinear,
                                      ShadowFilter::pcf_grid};

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
        {"SHADOW_REACH_TEXEL", "gnomon_reach_texel"},
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

/// Adds the shaders of one row to a library.
Result<gl::GlslNames> add_row(gl::GlslLibrary& library, std::string_view kind_file, const FilterRow& filter) {
    std::string text = "#include \"common/camera_block.glsl\"\n#include \"lighting/lights/light_sample.glsl\"\n";
    for (const std::string_view file : {kind_file, filter.file, std::string_view("shadow/lookup/light_vector.glsl"),
                                        std::string_view("shadow/lookup/shadow_layers.glsl")})
        text.append("#include \"").append(file).append("\"\n");
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", text});
    const bool linear = filter.reading == MapReading::compare_linear;
    const std::vector<std::string> defines = {"SHADOW_FLAT_MAP \"shadow/lookup/maps/flat_shared.glsl\"",
                                              "SHADOW_CUBE_MAP \"shadow/lookup/maps/cube_shared.glsl\"",
                                              "RAY_MASKS \"ray_tracing/alpha_mask.glsl\"",
                                              std::string("SHADOW_LINEAR_TAPS ") + (linear ? "1" : "0")};
    const auto expanded = gl::expand_shader(files, "row.glsl", defines);
    if (!expanded) return expanded.error();
    return library.add(expanded.value());
}

/// Names of the functions that one text calls.
struct Rows {
    std::vector<gl::GlslNames> kinds;     // by LookupKind, from cascades on
    std::vector<std::string> flat, cube;  // shadow_filter() by filter
};

/// A template's text, in which $name$ stands for a value.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
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

/// Appends a statement that runs only if `condition` holds. It is a loop, because software devices run both sides of an
/// if in full, but no round of a loop that is not needed.
void add_only_if(const std::string& condition, const std::string& statement, std::string& text) {
    text.append("    for (int once = ").append(condition).append(" ? 1 : 0; once > 0; --once) ").append(statement);
    text.append("\n");
}

/// The record of one light, read as texels for the reason in common/instance_buffer.glsl. gnomon_view() reads only what
/// its caller uses.
constexpr std::string_view kRecords = R"(
struct gnomon_Light {
$light$    ivec4 row;     // x: kind of lookup; y: number of the filter; z: 1: a sun; 2: a spot; 4: reads depths
    ivec4 place;   // x: unit; y: first layer of its depths; z: first layer of its triangles
    vec4 sizes;    // x: reach of the filter, texels; y: edge of the map, texels
};
struct gnomon_Camera {
$camera$};
const int gnomon_kHeadTexels = $head_texels$, gnomon_kLightTexels = $light_texels$, gnomon_kViewTexels = 9;
layout(binding = $records$) uniform usamplerBuffer gnomon_records;
layout(binding = $instances$) uniform usamplerBuffer gnomon_instance_texels;
layout(binding = $triangles$) uniform usamplerBuffer gnomon_caster_triangles;
layout(std430, binding = $masks$) restrict readonly buffer gnomon_Masks { uint gnomon_ray_masks[]; };
vec2 gnomon_pixel = vec2(0.5);
gnomon_Light gnomon_light;   // the light that is looked up
gnomon_Camera gnomon_camera;
int gnomon_first_view = 0;   // texel of its first view
bool gnomon_is_sun = false, gnomon_is_spot = false, gnomon_reads_depths = false;
float gnomon_reach_texel = 0.0, gnomon_map_edge_px = 1.0;

vec4 gnomon_floats(int texel) { return uintBitsToFloat(texelFetch(gnomon_records, texel)); }

ivec4 gnomon_ints(int texel) { return ivec4(texelFetch(gnomon_records, texel)); }

mat4 gnomon_matrix(int texel) {
    return mat4(gnomon_floats(texel), gnomon_floats(texel + 1), gnomon_floats(texel + 2), gnomon_floats(texel + 3));
}

$view$ gnomon_view(int i) {
    int texel = gnomon_first_view + gnomon_kViewTexels * i;
    return $view$(gnomon_matrix(texel), gnomon_floats(texel + 4), gnomon_floats(texel + 5), gnomon_floats(texel + 6),
                  gnomon_floats(texel + 7), gnomon_floats(texel + 8));
}

void gnomon_take(int light) {
    int texel = gnomon_kHeadTexels + gnomon_kLightTexels * light;
    gnomon_first_view = texel + $members$;
    int last = texel + gnomon_kLightTexels - 3;
    gnomon_light = gnomon_Light($load_light$gnomon_ints(last), gnomon_ints(last + 1), gnomon_floats(last + 2));
    gnomon_camera = gnomon_Camera($load_camera$);
    ivec4 row = gnomon_light.row;
    gnomon_is_sun = (row.z & 1) != 0;
    gnomon_is_spot = (row.z & 2) != 0;
    gnomon_reads_depths = (row.z & 4) != 0;
    gnomon_reach_texel = gnomon_light.sizes.x;
    gnomon_map_edge_px = gnomon_light.sizes.y;
}
)";

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

constexpr std::string_view kFlat = R"(
float gnomon_flat_visibility(vec3 position, vec3 normal, float error_m) {
    ivec4 row = gnomon_light.row;
    float reach_texel = gnomon_reads_depths ? 0.0 : gnomon_reach_texel;
    float visible = 1.0, share = 1.0;
    int lookup = 0;
    do {
        $point$ point;
$points$        float found = 1.0;
        for (int dark = $may_be_dark$(point) ? 1 : 0; dark > 0; --dark) {
            if ($on_plane$()) point = $move$(point, normal);
            if (gnomon_reads_depths) point.slope = $slope$(point, normal);
            point.normal = normal;
            point.error_m = error_m;
$filters$        }
        bool fades_into = row.x == 3 ? $cone_into$(point) : $cascade_into$(point);
        if (lookup > 0 && !fades_into) share = 0.0;
        visible = mix(visible, found, share);
        float next = row.x == 3 ? $cone_share$(point, reach_texel) : $cascade_share$(point, reach_texel);
        share = lookup == 0 ? next : 0.0;
        ++lookup;
    } while (share > 0.0);
    return visible;
}
)";

constexpr std::string_view kCube = R"(
float gnomon_cube_visibility(vec3 position, vec3 normal, float error_m) {
    ivec4 row = gnomon_light.row;
    float reach_texel = gnomon_reads_depths ? 0.0 : gnomon_reach_texel;
    float found = 1.0;
    $point$ point = $shadow_point$(0, position, normal, error_m, reach_texel);
    for (int dark = $may_be_dark$(point) ? 1 : 0; dark > 0; --dark) {
        if ($on_plane$()) point = $move$(point, normal);
        if (gnomon_reads_depths) point.slope = $slope$(point, normal);
        point.normal = normal;
        point.error_m = error_m;
$filters$    }
    return found;
}
)";

constexpr std::string_view kEntries = R"(
int gnomon_light_count() { return gnomon_ints(gnomon_kHeadTexels - 1).x; }

bool gnomon_takes_shadow(int light, int layers) {
    gnomon_take(light);
    return $takes_shadow$(float(layers));
}

float gnomon_visibility_of_taken(vec3 position, vec3 normal, float error_m, bool reached) {
    int kind = reached ? gnomon_light.row.x : 0;
    float visible = reached ? 1.0 : 0.0;
    for (gnomon_unit = 0; gnomon_unit < gnomon_kUnits; ++gnomon_unit) {
        bool here = gnomon_light.place.x == gnomon_unit;
        for (int once = here && kind >= 1 && kind <= 3 ? 1 : 0; once > 0; --once) visible = gnomon_flat_visibility(position, normal, error_m);
        for (int once = here && kind == 4 ? 1 : 0; once > 0; --once) visible = gnomon_cube_visibility(position, normal, error_m);
    }
    return visible;
}

float gnomon_visibility(int light, vec3 position, vec3 normal, float error_m) {
    gnomon_take(light);
    bool reached = !$unreached$(normal, $light_at$(position));
    return gnomon_visibility_of_taken(position, normal, error_m, reached);
}

float gnomon_visibility(int light, vec3 position, vec3 normal) {
    const float kFloatRounding = 1.0e-6;
    return gnomon_visibility(light, position, normal, kFloatRounding * length(position));
}

float gnomon_visibility(int light, vec3 position) {
    gnomon_take(light);
    vec3 to_light = $toward_light$(position);
    bool reached = $light_at$(position).reaches && dot(to_light, to_light) > 0.0;
    return gnomon_visibility_of_taken(position, normalize(to_light), 0.0, reached);
}
)";

/// Functions that read shared arrays. gnomon_unit is the number of a loop that all of a draw's pixels run in step: an
/// index into samplers must be the same for all.
constexpr std::string_view kReaders = R"(
const int gnomon_kUnits = $units$;
layout(binding = $depths$) uniform sampler2DArray gnomon_depths[gnomon_kUnits];
layout(binding = $ids$) uniform usampler2DArray gnomon_ids[gnomon_kUnits];
int gnomon_unit = 0;

float gnomon_shared_depth(vec3 at) {
    return textureLod(gnomon_depths[gnomon_unit], vec3(at.xy, at.z + float(gnomon_light.place.y)), 0.0).x;
}

vec4 gnomon_shared_depths(vec3 at) {
    return textureGather(gnomon_depths[gnomon_unit], vec3(at.xy, at.z + float(gnomon_light.place.y)));
}

uvec2 gnomon_shared_id(vec3 at) {
    return textureLod(gnomon_ids[gnomon_unit], vec3(at.xy, at.z + float(gnomon_light.place.z)), 0.0).xy;
}

$four$ gnomon_shared_ids(vec3 at) {
    vec3 place = vec3(at.xy, at.z + float(gnomon_light.place.z));
    $four$ found;
    found.instance = textureGather(gnomon_ids[gnomon_unit], place, 0);
    found.triangle = textureGather(gnomon_ids[gnomon_unit], place, 1);
    return found;
}
)";

Error refused(const char* rule, const char* what) { return {what, {}, {}, rule}; }

std::string filter_calls(const std::vector<std::string>& filters) {
    std::string text;
    for (std::size_t i = 0; i < filters.size(); ++i)
        add_only_if("row.y == " + std::to_string(i), "found = " + filters[i] + "(point);", text);
    return text;
}

}  // namespace

LookupUnits units_of(const LookupBindings& bindings) {
    LookupUnits units;
    units.arrays = (bindings.texture_unit_count - std::min(kTexelUnits, bindings.texture_unit_count)) / 2;
    units.first_depths = bindings.first_texture_unit;
    units.first_triangles = units.first_depths + units.arrays;
    units.first_texels = units.first_triangles + units.arrays;
    return units;
}

bool can_evaluate(ShadowFilter filter) {
    const FilterRow& row = shadow::filter_row(filter);
    return row.moments == nullptr && row.rays == nullptr;
}

std::span<const ShadowFilter> usual_filters() { return kUsualFilters; }

FilterChoice choose_filter(ShadowFilter filter, std::span<const ShadowFilter> filters) {
    const auto has = [&](ShadowFilter f) { return std::find(filters.begin(), filters.end(), f) != filters.end(); };
    if (has(filter)) return {.filter = filter, .alike = true};
    if (filter == ShadowFilter::hard && has(ShadowFilter::pcf_grid))
        return {.filter = ShadowFilter::pcf_grid, .alike = true, .one_tap = true};
    if (filter == ShadowFilter::hardware_2x2 && has(ShadowFilter::pcf_bilinear))
        return {.filter = ShadowFilter::pcf_bilinear, .alike = true, .one_tap = true};
    if (filter == ShadowFilter::sharp_4x4 && has(ShadowFilter::pcss))
        return {.filter = ShadowFilter::pcss, .alike = true, .without_source = true};
    const FilterRow& wanted = shadow::filter_row(filter);
    const auto distance = [&](ShadowFilter other) {
        const FilterRow& row = shadow::filter_row(other);
        // A prefiltered map's blur is that of a square of blended taps.
        const bool blends = wanted.moments != nullptr || wanted.reading == MapReading::compare_linear;
        int apart = row.width == wanted.width ? 0 : 8;
        apart += (row.reading == MapReading::compare_linear) == blends ? 0 : 2;
        apart += (row.reading == MapReading::depths) == (wanted.reading == MapReading::depths) ? 0 : 4;
        return apart + (row.storage.triangle_ids ? 32 : 0);
    };
    const ShadowFilter nearest = *std::min_element(
        filters.begin(), filters.end(), [&](ShadowFilter a, ShadowFilter b) { return distance(a) < distance(b); });
    const bool fixed = wanted.width == shadow::FilterWidth::fixed;
    return {.filter = nearest,
            .one_tap = fixed && shadow::filter_row(nearest).width == shadow::FilterWidth::size,
            .without_source = wanted.width != shadow::FilterWidth::source};
}

LookupKind lookup_kind(const shadow::ShaderKey& row) {
    if (row.kind_file == shadow::kWarpedSunFile) return LookupKind::warped_cascades;
    if (row.kind_file == shadow::kPerspectiveFile) return LookupKind::cone;
    if (row.kind_file == kCascadesFile) return LookupKind::cascades;
    return row.kind_file == kCubeFile ? LookupKind::cube : LookupKind::none;
}

Result<std::string> lookup_glsl(const LookupBindings& bindings, std::span<const ShadowFilter> filters) {
    if (bindings.texture_unit_count < kLeastTextureUnits)
        return refused("lookup.bindings", "lookups of all lights need more texture units");
    if (filters.empty() || !std::all_of(filters.begin(), filters.end(), can_evaluate))
        return refused("lookup.filters", "lookups of all lights have filters that read depths alone");
    gl::GlslLibrary library("gnomon_", replaced_names());
    library.replace_elements("light", "views", "gnomon_view");
    Rows rows;
    const FilterRow& plain = shadow::filter_row(filters.front());
    for (const std::string_view file : {kCascadesFile, shadow::kWarpedSunFile, shadow::kPerspectiveFile, kCubeFile}) {
        auto names = add_row(library, file, plain);
        if (!names) return names.error();
        rows.kinds.push_back(std::move(names).value());
    }
    for (const ShadowFilter filter : filters)
        for (const bool cube : {false, true}) {
            const auto names =
                add_row(library, cube ? kCubeFile : shadow::kPerspectiveFile, shadow::filter_row(filter));
            if (!names) return names.error();
            (cube ? rows.cube : rows.flat).push_back(names.value().at("shadow_filter"));
        }
    const auto name = [&](LookupKind kind, const char* of) {
        return rows.kinds[static_cast<std::size_t>(kind) - 1].at(of);
    };
    const LookupUnits units = units_of(bindings);
    const std::string four_triangles = name(LookupKind::cone, "FourTriangles");

    const Names first = {name(LookupKind::cone, "ViewRecord"), four_triangles};
    std::string text = library.text(first);
    const BlockText light = block_text(library.members("LightBlock"), "texel");
    const BlockText camera = block_text(library.members("CameraBlock"), "0");
    text += filled(kRecords, {{"light", light.members},
                              {"camera", camera.members},
                              {"head_texels", std::to_string(camera.texels + 1)},
                              {"light_texels", std::to_string(sizeof(LookupRecord) / gl::kTexelBytes)},
                              {"records", std::to_string(units.first_texels)},
                              {"instances", std::to_string(units.first_texels + 1)},
                              {"triangles", std::to_string(units.first_texels + 2)},
                              {"masks", std::to_string(bindings.storage_binding)},
                              {"view", name(LookupKind::cone, "ViewRecord")},
                              {"members", std::to_string(light.texels)},
                              {"load_light", light.loads + ", "},
                              {"load_camera", camera.loads}});
    text += filled(kReaders, {{"units", std::to_string(units.arrays)},
                              {"depths", std::to_string(units.first_depths)},
                              {"ids", std::to_string(units.first_triangles)},
                              {"four", four_triangles}});

    std::string points;
    Names roots;
    for (const LookupKind kind : {LookupKind::cascades, LookupKind::warped_cascades, LookupKind::cone}) {
        add_only_if("row.x == " + std::to_string(static_cast<int>(kind)),
                    "point = " + name(kind, "shadow_point") + "(lookup, position, normal, error_m, reach_texel);",
                    points);
        roots.insert(name(kind, "shadow_point"));
    }
    const auto common = [&](LookupKind kind) {
        std::map<std::string, std::string, std::less<>> values;
        for (const auto& [key, of] : {std::pair("point", "ShadowPoint"),
                                      {"may_be_dark", "may_be_dark"},
                                      {"on_plane", "compares_on_plane"},
                                      {"move", "on_receiver_plane"},
                                      {"slope", "shadow_slope"},
                                      {"shadow_point", "shadow_point"},
                                      {"takes_shadow", "takes_shadow"},
                                      {"unreached", "is_unreached"},
                                      {"light_at", "light_at"},
                                      {"toward_light", "toward_light"}}) {
            values[key] = name(kind, of);
            roots.insert(values[key]);
        }
        return values;
    };
    auto flat = common(LookupKind::cone), cube = common(LookupKind::cube);
    for (const auto& [key, kind] : {std::pair("cone", LookupKind::cone), {"cascade", LookupKind::cascades}}) {
        flat[std::string(key) + "_into"] = name(kind, "shadow_fades_into");
        flat[std::string(key) + "_share"] = name(kind, "shadow_fade_share");
        roots.insert({name(kind, "shadow_fades_into"), name(kind, "shadow_fade_share")});
    }
    flat["points"] = points;
    flat["filters"] = filter_calls(rows.flat);
    cube["filters"] = filter_calls(rows.cube);
    for (const auto* of : {&rows.flat, &rows.cube}) roots.insert(of->begin(), of->end());
    text += library.text(roots, first);
    text += filled(kFlat, flat) + filled(kCube, cube) + filled(kEntries, flat);
    return text;
}

}  // namespace gnomon::lookup
