#include "systems/shadow/frame/shader_key.h"

#include "systems/shadow/frame/shared_defines.h"

namespace gnomon::shadow {

namespace {

std::string flag(std::string_view name, bool is_set) { return std::string(name) + (is_set ? " 1" : " 0"); }

/// Returns what a lookup reads of the row's map: the last part of a file's name in shaders/shadow/lookup/maps.
std::string_view map_reading(const ShaderKey& row) {
    if (row.footprint) return "footprint";
    if (row.moments) return "moments";
    if (row.triangles) return "triangles";
    return row.depths ? "depths" : "compare";
}

std::string file(std::string_view name, const std::string& path) { return std::string(name) + " \"" + path + "\""; }

/// Returns the file that gives the colour of a light behind translucent casters.
std::string_view tint_file(TintLookup tint) {
    switch (tint) {
        case TintLookup::none:
            break;
        case TintLookup::layers:
            return "shadow/lookup/tint/layers.glsl";
        case TintLookup::rays:
            return "shadow/lookup/tint/rays.glsl";
    }
    return "shadow/lookup/tint/none.glsl";
}

}  // namespace

namespace {

bool is_area(std::string_view kind_define) {
    return kind_define == "LIGHT_RECTANGLE" || kind_define == "LIGHT_DISC" || kind_define == "LIGHT_SPHERE" ||
           kind_define == "LIGHT_TUBE";
}

}  // namespace

std::vector<std::string> program_defines(const ShaderKey& row) {
    const bool is_shadowed = !row.filter_file.empty();
    std::vector<std::string> defines;
    for (const std::string_view kind : {"LIGHT_DIRECTIONAL", "LIGHT_SPOT", "LIGHT_POINT", "LIGHT_RECTANGLE",
                                        "LIGHT_DISC", "LIGHT_SPHERE", "LIGHT_TUBE"})
        defines.push_back(flag(kind, kind == row.kind_define));
    defines.push_back(flag("LIGHT_AREA", is_area(row.kind_define)));
    defines.push_back("SHADOW_REACH_TEXEL " + std::to_string(row.reach_texel));
    defines.push_back(flag("SHADOW_DEPTHS", row.depths));
    defines.push_back(flag("SHADOW_MOMENTS", row.moments));
    defines.push_back(flag("SHADOW_FOOTPRINT", row.footprint));
    defines.push_back(flag("SHADOW_SHEETS", row.sheets));
    defines.push_back(flag("SHADOW_RAYS", row.rays));
    defines.push_back(flag("SHADOW_FADES", row.fades));
    defines.push_back(flag("SHADOW_MANUAL_BIAS", row.manual_bias));
    defines.push_back(flag("SHADOW_ANTIALIAS", row.area_shares == AreaShares::marked));
    defines.push_back(flag("SHADOW_SPREAD", row.area_shares == AreaShares::spread));
    defines.push_back(flag("SHADOW_OF_MIDDLE", is_shadowed && !row.whole_source));
    defines.push_back(file("RAY_MASKS", row.ray_masks ? "ray_tracing/alpha_mask.glsl" : "ray_tracing/no_masks.glsl"));
    const std::string reading(map_reading(row));
    defines.push_back(file("SHADOW_FLAT_MAP", "shadow/lookup/maps/flat_" + reading + ".glsl"));
    defines.push_back(file("SHADOW_CUBE_MAP", "shadow/lookup/maps/cube_" + reading + ".glsl"));
    const std::string answer = !is_shadowed ? "unshadowed" : (row.rays ? "by_rays" : "by_map");
    defines.push_back(file("SHADOW_TINT", std::string(tint_file(row.tint))));
    defines.push_back(file("SHADOW_VISIBILITY", "shadow/lookup/visibility/" + answer + ".glsl"));
    return defines;
}

std::vector<std::string> shared_defines(const SharedRow& row) {
    return {file("SHADOW_FLAT_MAP", "shadow/lookup/maps/flat_shared.glsl"),
            file("SHADOW_CUBE_MAP", "shadow/lookup/maps/cube_shared.glsl"),
            file("RAY_MASKS", row.ray_masks ? "ray_tracing/alpha_mask.glsl" : "ray_tracing/no_masks.glsl"),
            flag("LIGHT_AREA", false),
            flag("SHADOW_ANTIALIAS", row.antialias),
            flag("SHADOW_SPREAD", row.antialias),
            flag("SHADOW_LINEAR_TAPS", row.linear_taps),
            "SHADOW_REACH_TEXEL " + row.reach_texel};
}

std::string row_glsl(const ShaderKey& row) {
    if (row.filter_file.empty()) return {};
    std::string text;
    if (row.footprint || row.triangles || row.rays || row.area_shares == AreaShares::spread)
        text += "#include \"common/camera_block.glsl\"\n";
    for (const std::string_view file : {row.kind_file, row.filter_file})
        text += "#include \"" + std::string(file) + "\"\n";
    if (row.moments) text += "#include \"shadow/filters/prefiltered/without_bleeding.glsl\"\n";
    return text;
}

}  // namespace gnomon::shadow
