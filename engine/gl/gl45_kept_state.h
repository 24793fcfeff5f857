#pragma once
#include <array>
#include <vector>

#include "engine/gl/gl45_kept_pieces.h"
#include "engine/gl/gl45_state.h"

namespace gnomon::gl {

/// Subroutines that a user of the context chose. OpenGL forgets them whenever another program is used.
class KeptSubroutines {
public:
    /// Reads the choice of each stage of the program, or without one of the pipeline that is bound.
    void read(GLuint program);
    void write();

private:
    static constexpr std::size_t kStages = 6;
    std::array<std::vector<GLuint>, kStages> chosen_;  // by location
};

/// State that an engine finds as it was before a list. A piece is read before its first change and written only where
/// it differs, so that a list costs what it touches. Units and bindings that a program reads but the list leaves free
/// are unbound, so that nothing of the engine reaches a draw.
class KeptState final : public GlState {
public:
    explicit KeptState(const GlFixtures& fixtures);

    void begin_list() override;
    Failure end_list() override;
    std::size_t group_limit() override;
    void begin_pass(GLuint framebuffer, std::size_t colours, const Rect& viewport) override;
    void set_scissor(const Rect& rect) override;
    void set_depth_mask(bool writes) override;
    void use_pipeline(const PipelineState& state, const GlProgram& program) override;
    void use_compute(const GlProgram& program) override;
    void prepare_dispatch() override;
    void prepare_draw(GLuint layout, bool lines) override;
    void set_depth_range(float near_depth, float far_depth) override;
    void begin_blit() override;
    void end_blit() override;
    void bind_texture(std::uint32_t unit, GLenum target, GLuint texture, GLuint sampler) override;
    void bind_uniforms(std::uint32_t binding, GLuint buffer, std::uint32_t offset, std::uint32_t size) override;
    void bind_storage(std::uint32_t binding, GLuint buffer) override;
    void bind_meshes(GLuint vertices, GLuint items, GLuint indices, const MeshLayout& layout) override;
    void bind_draw_records(GLuint buffer) override;

private:
    static constexpr std::size_t kTargets = 11, kCapabilities = 31, kViewports = 16;
    struct Unit {
        std::array<Kept<TextureBinding>, kTargets> textures;
        Kept<SamplerBinding> sampler;
    };
    struct Colour {
        Kept<IndexedCapability> blend;
        Kept<BlendEquation> equation;
        Kept<BlendFunction> function;
        Kept<ColourMask> mask;
    };

    void set_enabled(GLenum capability, bool on);
    void set_fixed_state();
    void set_blend();
    void use(const GlProgram& program);
    void unbind_free_inputs();
    void restore_program();
    void restore_bindings();
    void restore_pieces();

    std::array<Kept<Capability>, kCapabilities> capabilities_;
    std::array<Kept<IndexedCapability>, kViewports> scissor_tests_;
    Kept<ClipControl> clip_;
    Kept<DepthRange> depth_range_;
    Kept<Viewport> viewport_;
    Kept<ScissorBox> scissor_box_;
    Kept<PolygonMode> polygon_mode_;
    Kept<LineWidth> line_width_;
    Kept<ProvokingVertex> provoking_;
    Kept<CullFace> cull_face_;
    Kept<FrontFace> front_face_;
    Kept<DepthFunction> depth_function_;
    Kept<DepthMask> depth_mask_;
    Kept<DrawFramebuffer> framebuffer_;
    Kept<VertexArray> vertex_array_;
    Kept<DrawRecordBuffer> draw_records_;
    Kept<ProgramInUse> program_;
    Kept<ActiveTexture> active_unit_;
    KeptSubroutines subroutines_;
    std::array<Colour, kMaxColourAttachments> colours_;
    std::array<Unit, GlFixtures::kTextureUnits> units_;
    std::array<Kept<BufferBinding>, GlFixtures::kBindings> uniforms_, storage_;

    std::size_t group_limit_ = 0;  // 0: not yet known
    std::size_t colour_count_ = 0;
    GlBlend blend_;
    const GlProgram* inputs_ = nullptr;  // program in use, until its free inputs are unbound
    bool fixed_ = false;                 // the state that lists do not set is set
    bool paused_feedback_ = false;       // transform feedback, to be resumed
    bool has_meshes_ = false;
};

}  // namespace gnomon::gl
