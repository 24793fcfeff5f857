#include "systems/lighting/light_lookup.h"

#include "shaders/bindings.h"

namespace gnomon::lighting {

LightProgram fallback_program(LightPrograms& programs, const shadow::LightingLight& light, ShaderPass output,
                              Reason lacks) {
    const shadow::FallbackLookup& plain = light.plain;
    const bool has_plain = !plain.row.filter_file.empty() && !(plain.row == light.row);
    const gl::ProgramHandle one_tap = has_plain ? programs.row(plain.row, output) : gl::ProgramHandle{};
    if (one_tap)
        return {.program = one_tap, .map = plain.map, .sampler = plain.sampler, .tint = light.tint, .lacks = lacks};
    shadow::ShaderKey unshadowed = light.row;
    unshadowed.filter_file = {};
    unshadowed.sheets = false;
    unshadowed.tint = shadow::TintLookup::none;
    return {.program = programs.row(unshadowed, output), .lacks = lacks, .unshadowed = true};
}

void bind_maps(const LightProgram& light, gl::CommandList& list) {
    if (light.map) list.add(gl::BindTexture{bindings::kShadowMapUnit, light.map, light.sampler});
    if (light.second) list.add(gl::BindTexture{bindings::kSecondDepthUnit, light.second, {}});
    if (light.bounds) list.add(gl::BindTexture{bindings::kBoundsUnit, light.bounds, {}});
    if (light.ends) list.add(gl::BindStorage{bindings::kPyramidBuffer, light.ends});
    bind_tint(light.tint, list);
}

void bind_tint(const shadow::TintTextures& tint, gl::CommandList& list) {
    if (tint.tree) list.add(gl::BindStorage{bindings::kTintBuffer, tint.tree});
    if (!tint.depths) return;
    list.add(gl::BindTexture{bindings::kTintDepthUnit, tint.depths, {}});
    list.add(gl::BindTexture{bindings::kTintUnit, tint.absorbances, {}});
}

void bind_triangles(const LightProgram& light, const GpuScene& gpu, gl::CommandList& list) {
    if (!light.triangles) return;
    list.add(gl::BindTexture{bindings::kShownTriangleUnit, light.triangles, {}});
    list.add(gl::BindTexels{bindings::kCasterTriangleUnit, gpu.caster_triangles()});
    list.add(gl::BindTexels{bindings::kInstanceUnit, gpu.instances()});
    if (gpu.caster_masks()) list.add(gl::BindStorage{bindings::kMaskBuffer, gpu.caster_masks()});
}

}  // namespace gnomon::lighting
