#pragma once
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "engine/gl/device.h"
#include "shaders/bindings.h"
#include "systems/lighting/light_lookup.h"

namespace gnomon::lighting {

/// Uniform block; matches KeptBlock in shaders/lighting/lights/visibility_cache.glsl (std140).
struct KeptRecord {
    glm::ivec4 area{0};
};

/// Visibility of one light with antialiased edges, a float per pixel. It takes the middles of all pixels first, as
/// without antialiased edges, and then the areas of the pixels that an edge may cross. Owns its device objects.
class EdgePass {
public:
    explicit EdgePass(gl::Device& device) : device_(device) {}
    ~EdgePass() { release(); }
    EdgePass(const EdgePass&) = delete;
    EdgePass& operator=(const EdgePass&) = delete;

    /// Creates or frees all, for pictures of that size. Returns false without room; lights then take the areas of all
    /// pixels, those by rays the middles.
    bool provide(bool wanted, glm::uvec2 size_px);
    bool is_there() const { return static_cast<bool>(target_); }

    /// Part of the picture that is drawn. `surfaces`: their depth. `farthest`: draws only surfaces before it, if given.
    struct Part {
        gl::TextureHandle surfaces{};
        gl::Rect area{};
        std::optional<float> farthest;
    };
    /// Records all draws of `light`, which has `edges`. `bind_inputs` records what its programs read.
    template <class BindInputs>
    void record(const LightProgram& light, const Part& part, gl::SamplerHandle sampler, const BindInputs& bind_inputs,
                gl::CommandList& list) const {
        begin(part, true, list);
        if (light.decided_program) draw(light.decided_program, part, true, bind_inputs, list);
        draw(light.program, part, false, bind_inputs, list);
        list.add(gl::EndPass{});
        list.add(gl::CopyTexture{part.surfaces, depth_, 0, part.area});
        list.add(gl::BeginPass{marks_target_, viewport(), false, 0.0f, false, {}});
        draw(
            light.edges.marks, part, true,
            [&] {
                list.add(gl::BindTexture{bindings::kKeptVisibilityUnit, shares_, sampler});
            },
            list);
        list.add(gl::EndPass{});
        list.add(gl::BindTexture{bindings::kKeptVisibilityUnit, {}, {}});
        begin(part, false, list);
        draw(light.edges.areas, part, false, bind_inputs, list);
        list.add(gl::EndPass{});
    }

    gl::TextureHandle shares() const { return shares_; }  // r32f; below 0: no surface, or none that the light reaches
    gl::TargetHandle target() const { return target_; }   // `shares`

private:
    gl::Rect viewport() const;
    void begin(const Part& part, bool first, gl::CommandList& list) const;
    template <class BindInputs>
    void draw(gl::ProgramHandle program, const Part& part, bool takes_depth, const BindInputs& bind_inputs,
              gl::CommandList& list) const {
        list.add(gl::SetScissor{part.area});
        list.add(gl::SetPipeline{
            {program, gl::CullMode::none, false, gl::DepthTest::less, takes_depth, false, gl::Blend::off}});
        bind_inputs();
        list.add(gl::DrawTriangle{part.farthest});
    }
    void release();

    gl::Device& device_;
    glm::uvec2 size_px_{0, 0};
    gl::TextureHandle shares_{}, depth_{};
    gl::TargetHandle target_{}, marks_target_{};
};

}  // namespace gnomon::lighting
