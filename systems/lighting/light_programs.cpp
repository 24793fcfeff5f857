#include "systems/lighting/light_programs.h"

#include "shaders/embedded.h"

namespace gnomon::lighting {
namespace {

/// The include "row.glsl" names the row's kind and filter; an unshadowed light's is empty.
std::string row_source(const shadow::ProgramRow* row) {
    if (!row || row->filter_file.empty()) return {};
    return "#include \"" + std::string(row->kind_file) + "\"\n#include \"" + std::string(row->filter_file) + "\"\n";
}

const char* output_name(RowOutput output) {
    switch (output) {
        case RowOutput::picture: return "light";
        case RowOutput::visibility: return "visibility";
        case RowOutput::blended: return "blended light";
    }
    return "light";
}

}  // namespace

LightPrograms::~LightPrograms() {
    for (const Entry& e : entries_) device_.destroy(e.program);
}

gl::ProgramHandle LightPrograms::get(const std::string& key, const char* vertex, const char* fragment,
                                     const std::vector<std::string>& defines, const shadow::ProgramRow* row) {
    for (const Entry& e : entries_)
        if (e.key == key) return e.program;
    const std::string row_text = row_source(row);
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", row_text});
    const auto v = gl::expand_shader(files, vertex, defines);
    const auto f = gl::expand_shader(files, fragment, defines);
    gl::ProgramHandle program{};
    if (v && f) program = device_.create_program({key, v.value(), f.value()}).handle;
    entries_.push_back({key, program});
    return program;
}

gl::ProgramHandle LightPrograms::row(const shadow::ProgramRow& row, RowOutput output) {
    std::vector<std::string> defines{std::string(row.kind_define) + " 1"};
    if (!row.filter_file.empty()) {
        defines.emplace_back("SHADOWED 1");
        defines.push_back("SHADOW_REACH_TEXEL " + std::to_string(row.reach_texel));
    }
    if (output == RowOutput::visibility) defines.emplace_back("WRITE_VISIBILITY 1");
    if (output == RowOutput::blended) defines.emplace_back("LIGHT_PASS 1");
    const std::string key = std::string(output_name(output)) + " " + std::string(row.kind_define) + " " + std::string(row.filter_file);
    return output == RowOutput::blended ? get(key, "lighting/surface.vert", "lighting/blended.frag", defines, &row)
                                        : get(key, "shared/fullscreen.vert", "lighting/light.frag", defines, &row);
}

gl::ProgramHandle LightPrograms::surface() { return get("surface", "lighting/surface.vert", "lighting/surface.frag", {}, nullptr); }
gl::ProgramHandle LightPrograms::blended_base() {
    return get("blended base", "lighting/surface.vert", "lighting/blended.frag", {}, nullptr);
}
gl::ProgramHandle LightPrograms::luminance() {
    return get("luminance", "shared/fullscreen.vert", "lighting/luminance.frag", {}, nullptr);
}
gl::ProgramHandle LightPrograms::tonemap() {
    return get("tonemap", "shared/fullscreen.vert", "lighting/tonemap.frag", {}, nullptr);
}

}  // namespace gnomon::lighting
