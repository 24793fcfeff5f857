#include "engine/gl/gl45_kept_state.h"

#include <algorithm>
#include <utility>

namespace gnomon::gl {
namespace {

struct StageRow {
    GLenum stage, subroutine_uniforms;
};
constexpr std::array<StageRow, 6> kStageRows = {{{GL_VERTEX_SHADER, GL_VERTEX_SUBROUTINE_UNIFORM},
                                                 {GL_TESS_CONTROL_SHADER, GL_TESS_CONTROL_SUBROUTINE_UNIFORM},
                                                 {GL_TESS_EVALUATION_SHADER, GL_TESS_EVALUATION_SUBROUTINE_UNIFORM},
                                                 {GL_GEOMETRY_SHADER, GL_GEOMETRY_SUBROUTINE_UNIFORM},
                                                 {GL_FRAGMENT_SHADER, GL_FRAGMENT_SUBROUTINE_UNIFORM},
                                                 {GL_COMPUTE_SHADER, GL_COMPUTE_SUBROUTINE_UNIFORM}}};

/// Returns the number of locations of subroutines in a stage, which may be missing.
GLint subroutine_locations(GLuint program, const StageRow& row) {
    GLint uniforms = 0, locations = 0;
    glGetProgramInterfaceiv(program, row.subroutine_uniforms, GL_ACTIVE_RESOURCES, &uniforms);
    if (uniforms > 0) glGetProgramStageiv(program, row.stage, GL_ACTIVE_SUBROUTINE_UNIFORM_LOCATIONS, &locations);
    return locations;
}

/// Capabilities that draws, clears and blits depend on, and their value while a list runs. Lists set the first four.
constexpr std::array<std::pair<GLenum, bool>, 31> kFixed = {{{GL_DEPTH_TEST, false},
                                                             {GL_DEPTH_CLAMP, false},
                                                             {GL_CULL_FACE, false},
                                                             {GL_FRAMEBUFFER_SRGB, false},
                                                             {GL_STENCIL_TEST, false},
                                                             {GL_COLOR_LOGIC_OP, false},
                                                             {GL_DITHER, false},
                                                             {GL_POLYGON_OFFSET_FILL, false},
                                                             {GL_POLYGON_OFFSET_LINE, false},
                                                             {GL_POLYGON_OFFSET_POINT, false},
                                                             {GL_POLYGON_SMOOTH, false},
                                                             {GL_LINE_SMOOTH, false},
                                                             {GL_PRIMITIVE_RESTART, false},
                                                             {GL_PRIMITIVE_RESTART_FIXED_INDEX, false},
                                                             {GL_RASTERIZER_DISCARD, false},
                                                             {GL_SAMPLE_ALPHA_TO_COVERAGE, false},
                                                             {GL_SAMPLE_ALPHA_TO_ONE, false},
                                                             {GL_SAMPLE_COVERAGE, false},
                                                             {GL_SAMPLE_MASK, false},
                                                             {GL_SAMPLE_SHADING, false},
                                                             {GL_CLIP_DISTANCE0, false},
                                                             {GL_CLIP_DISTANCE1, false},
                                                             {GL_CLIP_DISTANCE2, false},
                                                             {GL_CLIP_DISTANCE3, false},
                                                             {GL_CLIP_DISTANCE4, false},
                                                             {GL_CLIP_DISTANCE5, false},
                                                             {GL_CLIP_DISTANCE6, false},
                                                             {GL_CLIP_DISTANCE7, false},
                                                             {GL_TEXTURE_CUBE_MAP_SEAMLESS, true},
                                                             {GL_PROGRAM_POINT_SIZE, true},
                                                             {GL_MULTISAMPLE, true}}};

struct TargetRow {
    GLenum target, query;
};
constexpr std::array<TargetRow, 11> kTargetRows = {
    {{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
     {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
     {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
     {GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
     {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
     {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
     {GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
     {GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
     {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
     {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
     {GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE}}};

std::size_t row_of(GLenum target) {
    const auto* at = std::find_if(kTargetRows.begin(), kTargetRows.end(),
                                  [&](const TargetRow& row) { return row.target == target; });
    return static_cast<std::size_t>(at - kTargetRows.begin());
}

bool is_on(GLenum name) {
    GLboolean value = GL_FALSE;
    glGetBooleanv(name, &value);
    return value == GL_TRUE;
}

}  // namespace

void KeptSubroutines::read(GLuint program) {
    GLint pipeline = 0;
    if (program == 0) glGetIntegerv(GL_PROGRAM_PIPELINE_BINDING, &pipeline);
    for (std::size_t i = 0; i < kStages; ++i) {
        chosen_[i].clear();
        const GLenum stage = kStageRows[i].stage;
        auto of_stage = static_cast<GLint>(program);
        if (pipeline != 0) glGetProgramPipelineiv(static_cast<GLuint>(pipeline), stage, &of_stage);
        if (of_stage == 0) continue;
        const GLint locations = subroutine_locations(static_cast<GLuint>(of_stage), kStageRows[i]);
        for (GLint location = 0; location < locations; ++location)
            glGetUniformSubroutineuiv(stage, location, &chosen_[i].emplace_back());
    }
}

void KeptSubroutines::write() {
    for (std::size_t i = 0; i < kStages; ++i) {
        if (chosen_[i].empty()) continue;
        glUniformSubroutinesuiv(kStageRows[i].stage, static_cast<GLsizei>(chosen_[i].size()), chosen_[i].data());
        chosen_[i].clear();
    }
}

KeptState::KeptState(const GlFixtures& fixtures) : GlState(fixtures) {
    static_assert(kFixed.size() == kCapabilities && kTargetRows.size() == kTargets);
    for (std::size_t i = 0; i < kCapabilities; ++i) capabilities_[i] = Kept(Capability{kFixed[i].first});
    for (GLuint i = 0; i < kViewports; ++i) scissor_tests_[i] = Kept(IndexedCapability{GL_SCISSOR_TEST, i});
    for (GLuint i = 0; i < colours_.size(); ++i) {
        colours_[i] = {Kept(IndexedCapability{GL_BLEND, i}), Kept(BlendEquation{i}), Kept(BlendFunction{i}),
                       Kept(ColourMask{i})};
    }
    for (GLuint unit = 0; unit < units_.size(); ++unit) {
        for (std::size_t i = 0; i < kTargets; ++i)
            units_[unit].textures[i] = Kept(TextureBinding{kTargetRows[i].target, kTargetRows[i].query});
        units_[unit].sampler = Kept(SamplerBinding{unit});
    }
    for (GLuint i = 0; i < uniforms_.size(); ++i) {
        uniforms_[i] = Kept(BufferBinding{GL_UNIFORM_BUFFER, i});
        storage_[i] = Kept(BufferBinding{GL_SHADER_STORAGE_BUFFER, i});
    }
}

void KeptState::begin_list() {
    group_limit_ = colour_count_ = 0;
    blend_ = {};
    scissor_ = {};
    in_target_ = fixed_ = has_meshes_ = false;
    inputs_ = nullptr;
}

Failure KeptState::end_list() {
    if (has_meshes_) drop_meshes();
    const Failure error = take_gl_error();  // what cannot be given back is no error of the list
    restore_bindings();
    restore_pieces();
    restore_program();
    return error;
}

std::size_t KeptState::group_limit() {
    if (group_limit_ == 0) {
        GLint depth = 1;  // engine's own groups and the default one
        glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
        const std::size_t taken = static_cast<std::size_t>(std::max(depth, 1)) - 1;
        group_limit_ = 1 + fixtures_.group_depth - std::min(taken, fixtures_.group_depth);
    }
    return group_limit_ - 1;
}

void KeptState::set_enabled(GLenum capability, bool on) {
    for (std::size_t i = 0; i < kCapabilities; ++i)
        if (kFixed[i].first == capability) return capabilities_[i].set(on);
}

/// Sets what GlState::begin_list sets, and what an engine must leave at its default there. Without a draw, nothing.
void KeptState::set_fixed_state() {
    if (std::exchange(fixed_, true)) return;
    for (std::size_t i = 0; i < kCapabilities; ++i) capabilities_[i].set(kFixed[i].second);
    // Mesa 22 draws nothing through a viewport without a test while another one has it.
    for (Kept<IndexedCapability>& test : scissor_tests_) test.set(false);
    clip_.set({GL_LOWER_LEFT, GL_ZERO_TO_ONE});
    depth_range_.set({0.0, 1.0});
    polygon_mode_.set(GL_FILL);
    provoking_.set(GL_LAST_VERTEX_CONVENTION);
}

void KeptState::begin_pass(GLuint framebuffer, std::size_t colours, const Rect& viewport) {
    set_fixed_state();
    in_target_ = framebuffer != 0;
    colour_count_ = std::min(colours, colours_.size());
    framebuffer_.set(static_cast<GLint>(framebuffer));
    set_enabled(GL_FRAMEBUFFER_SRGB, in_target_);
    viewport_.set({static_cast<float>(viewport.x), static_cast<float>(viewport.y), static_cast<float>(viewport.width),
                   static_cast<float>(viewport.height)});
    set_scissor({});
    for (std::size_t i = 0; i < colour_count_; ++i) colours_[i].mask.set({GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE});
    set_blend();
}

void KeptState::set_scissor(const Rect& rect) {
    scissor_ = rect;
    scissor_tests_[0].set(rect.width > 0);
    if (rect.width > 0) scissor_box_.set({rect.x, rect.y, rect.width, rect.height});
}

void KeptState::set_depth_mask(bool writes) { depth_mask_.set(writes); }

void KeptState::set_blend() {
    for (std::size_t i = 0; i < colour_count_; ++i) {
        Colour& colour = colours_[i];
        colour.blend.set(blend_.enabled);
        if (blend_.enabled) colour.equation.set({blend_.equation, blend_.equation});
        if (blend_.has_function)
            colour.function.set({blend_.source_colour, blend_.target_colour, blend_.source_alpha, blend_.target_alpha});
    }
}

void KeptState::use(const GlProgram& program) {
    if (!program_.known()) {
        // The program may not change while transform feedback runs.
        paused_feedback_ = is_on(GL_TRANSFORM_FEEDBACK_ACTIVE) && !is_on(GL_TRANSFORM_FEEDBACK_PAUSED);
        if (paused_feedback_) glPauseTransformFeedback();
        subroutines_.read(static_cast<GLuint>(ProgramInUse::read()));
    }
    program_.set(static_cast<GLint>(program.name));
    inputs_ = &program;
}

void KeptState::use_pipeline(const PipelineState& state, const GlProgram& program) {
    set_fixed_state();
    use(program);
    set_enabled(GL_CULL_FACE, state.cull != CullMode::none);
    if (state.cull != CullMode::none) cull_face_.set(state.cull == CullMode::front ? GL_FRONT : GL_BACK);
    front_face_.set(state.front_is_clockwise ? GL_CW : GL_CCW);
    const bool tests = state.depth_test != DepthTest::off || state.depth_write;
    set_enabled(GL_DEPTH_TEST, tests);
    if (tests) depth_function_.set(static_cast<GLint>(gl_depth_test(state.depth_test)));
    depth_mask_.set(state.depth_write);
    set_enabled(GL_DEPTH_CLAMP, state.depth_clamp);
    blend_ = gl_blend(state.blend);
    set_blend();
}

void KeptState::use_compute(const GlProgram& program) { use(program); }

void KeptState::prepare_dispatch() { unbind_free_inputs(); }

void KeptState::prepare_draw(GLuint layout, bool lines) {
    unbind_free_inputs();
    if (lines) line_width_.set(1.0f);
    vertex_array_.set(static_cast<GLint>(layout));
}

void KeptState::set_depth_range(float near_depth, float far_depth) {
    depth_range_.set({static_cast<double>(near_depth), static_cast<double>(far_depth)});
}

void KeptState::begin_blit() {
    set_fixed_state();
    scissor_tests_[0].set(false);
    set_enabled(GL_FRAMEBUFFER_SRGB, false);
}

void KeptState::end_blit() {
    set_scissor(scissor_);
    set_enabled(GL_FRAMEBUFFER_SRGB, in_target_);
}

void KeptState::bind_texture(std::uint32_t unit, GLenum target, GLuint texture, GLuint sampler) {
    active_unit_.set(static_cast<GLint>(GL_TEXTURE0 + unit));
    Unit& at = units_[unit];
    if (texture != 0) {
        at.textures[row_of(target)].set(texture);
    } else {
        for (Kept<TextureBinding>& bound : at.textures)
            if (bound.known()) bound.set(0);
    }
    at.sampler.set(sampler);
}

void KeptState::bind_uniforms(std::uint32_t binding, GLuint buffer, std::uint32_t offset, std::uint32_t size) {
    uniforms_[binding].set({buffer, offset, size});
}

void KeptState::bind_storage(std::uint32_t binding, GLuint buffer) { storage_[binding].set({buffer, 0, 0}); }

void KeptState::bind_meshes(GLuint vertices, GLuint items, GLuint indices, const MeshLayout& layout) {
    GlState::bind_meshes(vertices, items, indices, layout);
    has_meshes_ = true;
}

void KeptState::bind_draw_records(GLuint buffer) { draw_records_.set(static_cast<GLint>(buffer)); }

void KeptState::unbind_free_inputs() {
    const GlProgram* program = std::exchange(inputs_, nullptr);
    if (program == nullptr) return;
    for (const GlInput& input : program->inputs) {
        if (input.kind == GL_UNIFORM_BUFFER || input.kind == GL_SHADER_STORAGE_BUFFER) {
            auto& bindings = input.kind == GL_UNIFORM_BUFFER ? uniforms_ : storage_;
            if (input.slot < bindings.size() && !bindings[input.slot].known()) bindings[input.slot].set({});
        } else if (input.slot < units_.size()) {
            Kept<TextureBinding>& bound = units_[input.slot].textures[row_of(input.kind)];
            if (bound.known()) continue;
            active_unit_.set(static_cast<GLint>(GL_TEXTURE0 + input.slot));
            bound.set(0);
        }
    }
}

void KeptState::restore_program() {
    if (!program_.known()) return;
    program_.restore();
    subroutines_.write();
    if (std::exchange(paused_feedback_, false)) glResumeTransformFeedback();
}

void KeptState::restore_bindings() {
    for (std::size_t i = 0; i < units_.size(); ++i) {
        for (Kept<TextureBinding>& bound : units_[i].textures) {
            if (!bound.known()) continue;
            active_unit_.set(static_cast<GLint>(GL_TEXTURE0 + i));
            bound.restore();
        }
        units_[i].sampler.restore();
    }
    active_unit_.restore();
    for (Kept<BufferBinding>& binding : uniforms_) binding.restore();
    for (Kept<BufferBinding>& binding : storage_) binding.restore();
    vertex_array_.restore();
    draw_records_.restore();
    framebuffer_.restore();
}

void KeptState::restore_pieces() {
    for (Kept<Capability>& capability : capabilities_) capability.restore();
    for (Colour& colour : colours_) {
        colour.blend.restore();
        colour.equation.restore();
        colour.function.restore();
        colour.mask.restore();
    }
    for (Kept<IndexedCapability>& test : scissor_tests_) test.restore();
    clip_.restore();
    depth_range_.restore();
    viewport_.restore();
    scissor_box_.restore();
    polygon_mode_.restore();
    line_width_.restore();
    provoking_.restore();
    cull_face_.restore();
    front_face_.restore();
    depth_function_.restore();
    depth_mask_.restore();
}

}  // namespace gnomon::gl
