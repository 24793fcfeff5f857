#include "systems/shadow/frame/shader_key.h"

namespace gnomon::shadow {

std::vector<std::string> program_defines(const ProgramRow& row) {
    std::vector<std::string> defines{std::string(row.kind_define) + " 1"};
    if (row.filter_file.empty()) return defines;
    defines.emplace_back("SHADOWED 1");
    defines.push_back("SHADOW_REACH_TEXEL " + std::to_string(row.reach_texel));
    if (row.depths) defines.emplace_back("SHADOW_DEPTHS 1");
    if (row.moments) defines.emplace_back("SHADOW_MOMENTS 1");
    if (row.footprint) defines.emplace_back("SHADOW_FOOTPRINT 1");
    if (row.triangles) defines.emplace_back("SHADOW_TRIANGLES 1");
    if (row.sheets) defines.emplace_back("SHADOW_SHEETS 1");
    if (row.rays) defines.emplace_back("SHADOW_RAYS 1");
    if (row.ray_masks) defines.emplace_back("RAY_MASKS 1");
    if (row.fades) defines.emplace_back("SHADOW_FADES 1");
    if (row.manual_bias) defines.emplace_back("SHADOW_MANUAL_BIAS 1");
    return defines;
}

std::string row_glsl(const ProgramRow& row) {
    if (row.filter_file.empty()) return {};
    std::string text;
    if (row.footprint || row.triangles || row.rays) text += "#include \"common/camera_block.glsl\"\n";
    for (const std::string_view file : {row.kind_file, row.filter_file})
        text += "#include \"" + std::string(file) + "\"\n";
    return text;
}

}  // namespace gnomon::shadow
