#pragma once
#include "systems/extract/gpu_scene.h"
#include "systems/lighting/light_programs.h"
#include "systems/shadow/frame/lighting_inputs.h"

/// Program that looks a light up, and what it reads.
namespace gnomon::lighting {

/// Programs of EdgePass that follow its first two draws; {0}: the light is not drawn by it.
struct EdgePrograms {
    gl::ProgramHandle marks{}, areas{};
    gl::ProgramHandle reads{};  // draws the shares that it has found
    explicit operator bool() const { return marks && areas && reads; }
};

/// Program of a light, and its inputs.
struct LightProgram {
    gl::ProgramHandle program{};
    gl::TextureHandle map{}, triangles{};
    gl::SamplerHandle sampler{};
    visibility::RayBuffers rays{};
    gl::TextureHandle second{}, bounds{};                  // for maps of sheets
    gl::BufferHandle ends{};                               // for area lights on such maps
    shadow::TintTextures tint{};                           // for rows with a TintLookup
    gl::ProgramHandle verdicts_program{}, rays_program{};  // {0}: `program` traces the rays itself
    gl::ProgramHandle decided_program{};  // draws all but slow pixels, which remain for `program`; {0}: none
    EdgePrograms edges{};                 // with these, the two draw middles, or `program` alone those of rays
    Reason lacks = Reason::none;          // reason why it is not the light's own row
    bool unshadowed = false;
};

/// Returns a program in place of a light's own row, for the reason `lacks`: one tap of its map, otherwise the light
/// without shadow.
LightProgram fallback_program(LightPrograms& programs, const shadow::LightingLight& light, ShaderPass output,
                              Reason lacks);

/// Binds the light's maps: depths, and what conservative maps have beside them.
void bind_maps(const LightProgram& light, gl::CommandList& list);

/// Binds a light's layers of translucent casters, or the tree of all; nothing without.
void bind_tint(const shadow::TintTextures& tint, gl::CommandList& list);

/// Binds what a row with triangles reads beside its map; nothing for other rows.
void bind_triangles(const LightProgram& light, const GpuScene& gpu, gl::CommandList& list);

}  // namespace gnomon::lighting
