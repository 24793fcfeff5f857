#include "systems/lighting/light_programs.h"

#include <algorithm>

#include "shaders/embedded.h"

namespace gnomon::lighting {
namespace {

const char* output_name(ShaderPass output) {
    switch (output) {
        case ShaderPass::picture:
            return "light";
        case ShaderPass::visibility:
            return "visibility";
        case ShaderPass::blended:
            return "blended light";
        case ShaderPass::catcher:
            return "caught light";
        case ShaderPass::lookups:
            return "lookups";
        case ShaderPass::verdicts:
            return "verdicts";
        case ShaderPass::rays:
            return "rays";
        case ShaderPass::kept:
            return "kept light";
        case ShaderPass::kept_visibility:
            return "kept visibility";
        case ShaderPass::decided:
            return "decided light";
        case ShaderPass::decided_visibility:
            return "decided visibility";
        case ShaderPass::decided_middles:
            return "decided middles";
        case ShaderPass::undecided_middles:
            return "undecided middles";
        case ShaderPass::crossed_areas:
            return "crossed areas";
        case ShaderPass::found_middles:
            return "found middles";
        case ShaderPass::tint:
            return "tint";
        case ShaderPass::fog:
            return "light in fog";
    }
    return "light";
}

/// Returns what the state of a middle adds to its share, in GLSL; empty: the output is not one of EdgePass's first
/// draws. `listed`: the map's verdicts are kept, and rays have found the rest.
std::string_view middle_state(ShaderPass output, bool listed) {
    if (output == ShaderPass::undecided_middles) return "kUndecided";
    if (output == ShaderPass::found_middles && listed) return "kUndecided * float(is_listed(ivec2(gl_FragCoord.xy)))";
    return output == ShaderPass::decided_middles || output == ShaderPass::found_middles ? "0.0" : "";
}

/// Returns true if the output adds light to the picture. Passes over blended surfaces draw only lit ones.
bool adds_to_picture(ShaderPass output) {
    return output == ShaderPass::picture || output == ShaderPass::kept || output == ShaderPass::decided;
}

/// Returns true if the output shows light in its colour, and so reads what translucent casters let through.
bool reads_tint(ShaderPass output) {
    return adds_to_picture(output) || is_forward(output) || output == ShaderPass::tint || output == ShaderPass::fog;
}

/// Returns the file under shaders/ that gives the share of a light that a surface sees.
std::string_view visible_share_file(ShaderPass output, bool found_before) {
    if (output == ShaderPass::kept || output == ShaderPass::kept_visibility)
        return "lighting/lights/visibility_cache.glsl";
    return found_before ? "lighting/trace/ray_results.glsl" : "lighting/lights/surface_visibility.glsl";
}

/// Returns the fragment shader, under shaders/, that draws a light over its rectangle.
std::string_view fragment_file(ShaderPass output) {
    if (output == ShaderPass::tint) return "lighting/lights/tint.frag";
    if (output == ShaderPass::fog) return "lighting/fog/fog_light.frag";
    const bool is_share = output == ShaderPass::visibility || output == ShaderPass::kept_visibility ||
                          output == ShaderPass::decided_visibility || output == ShaderPass::crossed_areas ||
                          !middle_state(output, false).empty();
    return is_share ? "lighting/lights/visibility.frag" : "lighting/lights/light.frag";
}

/// Returns the fragment shader, under shaders/, that draws a light on meshes.
std::string_view forward_file(ShaderPass output) {
    return output == ShaderPass::catcher ? "lighting/catchers/caught_light.frag" : "lighting/lights/blended_light.frag";
}

}  // namespace

LightPrograms::~LightPrograms() {
    for (const RowEntry& e : rows_) device_.destroy(e.entry.program);
    for (const Entry& e : imports_) device_.destroy(e.program);
    for (const Entry& e :
         {surface_, surface_places_, blended_base_, luminance_, tonemap_, unlit_surface_, unlit_surface_places_,
          unlit_blended_, mark_edges_, tonemap_transparent_, catcher_base_, catcher_shares_, fog_base_})
        device_.destroy(e.program);
}

void LightPrograms::set_coloured(bool coloured) {
    if (coloured == coloured_) return;
    coloured_ = coloured;
    for (Entry* entry : {&surface_, &surface_places_, &blended_base_, &unlit_surface_, &unlit_surface_places_,
                         &unlit_blended_, &catcher_base_}) {
        device_.destroy(entry->program);
        *entry = {};
    }
    std::erase_if(rows_, [&](const RowEntry& row) {
        if (is_forward(row.output)) device_.destroy(row.entry.program);
        return is_forward(row.output);
    });
}

void LightPrograms::make(Entry& entry, const std::string& label, std::string_view vertex, std::string_view fragment,
                         std::span<const std::string> defines, const shadow::ShaderKey* row) {
    const std::string row_text = row ? shadow::row_glsl(*row) : std::string();
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", row_text});
    const auto v = gl::expand_shader(files, vertex, defines);
    const auto f = gl::expand_shader(files, fragment, defines);
    failure_ = gl::Failure::compile_failed;
    if (v && f) {
        const auto made = device_.create_program({label, v.value(), f.value()});
        entry.program = made.handle;
        failure_ = made.failure;
    }
    if (!entry.program) entry.retry.failed(frame_);
}

LightPrograms::RowEntry& LightPrograms::find_or_add(const shadow::ShaderKey& wanted, ShaderPass output,
                                                    std::string_view fragment) {
    shadow::ShaderKey row = wanted;
    const bool reads_answers = row.sheets && (output == ShaderPass::picture || output == ShaderPass::visibility ||
                                              output == ShaderPass::found_middles);
    const bool marks = row.area_shares == shadow::AreaShares::marked;
    if (marks && row.rays && output != ShaderPass::crossed_areas) row.area_shares = shadow::AreaShares::none;
    if (row.filter_file.empty() || reads_answers) row = {row.kind_define, {}, {}};  // one program per kind
    row.sheets = wanted.sheets;
    row.tint = reads_tint(output) ? wanted.tint : shadow::TintLookup::none;
    const bool some_unlit = some_unlit_ && adds_to_picture(output);
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const RowEntry& e) {
        return e.output == output && e.fragment == fragment && e.some_unlit == some_unlit && e.row == row;
    });
    return found != rows_.end() ? *found : rows_.emplace_back(RowEntry{row, output, fragment, some_unlit, {}});
}

bool LightPrograms::must_wait(const shadow::ShaderKey& row, ShaderPass output) {
    if (!is_due(find_or_add(row, output, {}).entry)) return false;
    if (rows_left_ == 0) return true;
    --rows_left_;
    return false;
}

gl::ProgramHandle LightPrograms::find_or_make(const shadow::ShaderKey& wanted, ShaderPass output,
                                              std::string_view fragment) {
    RowEntry& found = find_or_add(wanted, output, fragment);
    const shadow::ShaderKey& row = found.row;
    Entry& entry = found.entry;
    if (!is_due(entry)) return entry.program;

    std::vector<std::string> defines = shadow::program_defines(row);
    const bool found_before = row.filter_file.empty() && row.sheets;
    defines.push_back("VISIBLE_SHARE \"" + std::string(visible_share_file(output, found_before)) + "\"");
    if (is_forward(output) && coloured_) defines.emplace_back("COLOURED 1");
    if (output == ShaderPass::catcher) defines.emplace_back("INVARIANT_POSITION 1");
    if (output == ShaderPass::crossed_areas) defines.emplace_back("AREAS_ALONE 1");
    if (const std::string_view state = middle_state(output, found_before); !state.empty())
        defines.push_back("MIDDLES " + std::string(state));
    if (output == ShaderPass::decided || output == ShaderPass::decided_visibility ||
        output == ShaderPass::decided_middles)
        defines.emplace_back("LEAVE_UNDECIDED 1");
    if (output == ShaderPass::lookups) defines.emplace_back("SHADOW_SHOWN 1");
    if (found.some_unlit) defines.emplace_back("SOME_UNLIT 1");
    const std::string label = std::string(output_name(output)) + (fragment.empty() ? "" : " " + std::string(fragment)) +
                              " " + std::string(row.kind_define) + " " + std::string(row.filter_file) +
                              (row.manual_bias ? " manual bias" : "") +
                              (row.area_shares == shadow::AreaShares::marked ? " antialiased" : "") +
                              (row.tint != shadow::TintLookup::none ? " tinted" : "") +
                              (found_before ? "as found" : "") + (found.some_unlit ? " some unlit" : "");
    if (is_forward(output))
        make(entry, label, "lighting/gbuffer/gbuffer.vert", forward_file(output), defines, &row);
    else if (output == ShaderPass::verdicts)
        make(entry, label, "common/fullscreen.vert", "lighting/trace/classify_pixels.frag", defines, &row);
    else if (output == ShaderPass::rays)
        make(entry, label, "lighting/trace/trace_pixels.vert", "lighting/trace/trace_pixels.frag", defines, &row);
    else
        make(entry, label, "common/fullscreen.vert", fragment.empty() ? fragment_file(output) : fragment, defines,
             &row);
    return entry.program;
}

gl::ProgramHandle LightPrograms::needed(Entry& entry, const char* label, const char* vertex, const char* fragment,
                                        std::span<const std::string> defines) {
    if (!entry.program) make(entry, label, vertex, fragment, defines, nullptr);
    return entry.program;
}

void LightPrograms::make_of_meshes(Entry& entry, const char* label, const char* fragment,
                                   std::initializer_list<const char*> defines) {
    std::vector<std::string> all(defines.begin(), defines.end());
    if (coloured_) all.emplace_back("COLOURED 1");
    make(entry, coloured_ ? std::string(label) + ", coloured" : label, "lighting/gbuffer/gbuffer.vert", fragment, all,
         nullptr);
}
gl::ProgramHandle LightPrograms::surface(bool places) {
    Entry& entry = places ? surface_places_ : surface_;
    if (entry.program) return entry.program;
    if (places)
        make_of_meshes(entry, "surface with places", "lighting/gbuffer/gbuffer.frag", {"WRITE_PLACES 1"});
    else
        make_of_meshes(entry, "surface", "lighting/gbuffer/gbuffer.frag", {});
    return entry.program;
}
gl::ProgramHandle LightPrograms::blended_base() {
    if (is_due(blended_base_)) make_of_meshes(blended_base_, "blended base", "lighting/lights/blended.frag", {});
    return blended_base_.program;
}
gl::ProgramHandle LightPrograms::unlit_surface(bool places) {
    Entry& entry = places ? unlit_surface_places_ : unlit_surface_;
    if (!is_due(entry)) return entry.program;
    if (places)
        make_of_meshes(entry, "unlit surface with places", "lighting/gbuffer/gbuffer.frag",
                       {"UNLIT 1", "WRITE_PLACES 1"});
    else
        make_of_meshes(entry, "unlit surface", "lighting/gbuffer/gbuffer.frag", {"UNLIT 1"});
    return entry.program;
}
gl::ProgramHandle LightPrograms::unlit_blended() {
    if (is_due(unlit_blended_))
        make_of_meshes(unlit_blended_, "unlit blended", "lighting/lights/blended.frag", {"UNLIT 1"});
    return unlit_blended_.program;
}
gl::ProgramHandle LightPrograms::import_surfaces(bool multisampled, bool has_normals) {
    const std::string defines[] = {std::string("MULTISAMPLED ") + (multisampled ? "1" : "0"),
                                   std::string("HAS_NORMALS ") + (has_normals ? "1" : "0")};
    return needed(imports_[(multisampled ? 1 : 0) + (has_normals ? 2 : 0)], "imported surfaces",
                  "common/fullscreen.vert", "lighting/mask/import_surfaces.frag", defines);
}
gl::ProgramHandle LightPrograms::mark_edges() {
    if (is_due(mark_edges_))
        make(mark_edges_, "marked edges", "common/fullscreen.vert", "lighting/edges/mark_edges.frag", {}, nullptr);
    return mark_edges_.program;
}
gl::ProgramHandle LightPrograms::catcher_base() {
    if (is_due(catcher_base_))
        make_of_meshes(catcher_base_, "catcher base", "lighting/catchers/catcher_base.frag", {"INVARIANT_POSITION 1"});
    return catcher_base_.program;
}
gl::ProgramHandle LightPrograms::catcher_shares() {
    if (is_due(catcher_shares_))
        make(catcher_shares_, "catcher shares", "common/fullscreen.vert", "lighting/catchers/catcher_shares.frag", {},
             nullptr);
    return catcher_shares_.program;
}
gl::ProgramHandle LightPrograms::fog_base() {
    if (is_due(fog_base_))
        make(fog_base_, "fog base", "common/fullscreen.vert", "lighting/fog/fog_base.frag", {}, nullptr);
    return fog_base_.program;
}
gl::ProgramHandle LightPrograms::luminance() {
    return needed(luminance_, "luminance", "common/fullscreen.vert", "lighting/post/luminance.frag");
}
gl::ProgramHandle LightPrograms::tonemap(bool transparent) {
    const char* const file = "lighting/post/tonemap.frag";
    if (!transparent) return needed(tonemap_, "tonemap", "common/fullscreen.vert", file);
    const std::string define = "TRANSPARENT 1";
    return needed(tonemap_transparent_, "transparent tonemap", "common/fullscreen.vert", file, {&define, 1});
}

}  // namespace gnomon::lighting
