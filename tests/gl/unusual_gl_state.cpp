#include "tests/gl/unusual_gl_state.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace gnomon {
namespace {

constexpr GLsizeiptr kBuffer_bytes = 1 << 16;

// A program starts with subroutine 0 of each stage.
constexpr const char* kVertex = R"(#version 450 core
subroutine float Choice();
layout(location = 0) subroutine uniform Choice choice;
layout(index = 0) subroutine(Choice) float first() { return 1.0; }
layout(index = 1) subroutine(Choice) float second() { return 2.0; }
out gl_PerVertex { vec4 gl_Position; };
out float written;
void main() { written = choice(); gl_Position = vec4(choice()); }
)";
constexpr const char* kFragment = R"(#version 450 core
subroutine vec4 Colour();
layout(location = 0) subroutine uniform Colour colour;
layout(index = 0) subroutine(Colour) vec4 black() { return vec4(0.0); }
layout(index = 1) subroutine(Colour) vec4 white() { return vec4(1.0); }
layout(location = 0) out vec4 result;
void main() { result = colour(); }
)";

GLint limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void choose_second_subroutines() {
    const GLuint second = 1;
    glUniformSubroutinesuiv(GL_VERTEX_SHADER, 1, &second);
    glUniformSubroutinesuiv(GL_FRAGMENT_SHADER, 1, &second);
}

void hear_complaint(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* to) {
    if (type == GL_DEBUG_TYPE_PERFORMANCE) return;  // advice
    if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
        const_cast<std::vector<std::string>*>(static_cast<const std::vector<std::string>*>(to))->emplace_back(text);
}

}  // namespace

UnusualGlState::UnusualGlState(EngineWork work) : work_(work) {
    set_modes();
    set_transfer();
    set_indexed();
    bind_textures();
    bind_buffers();
    bind_vertices();
    bind_framebuffers();
    use_programs();
    run_queries();
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR}) << "the test's own state is legal";
    while (glGetDebugMessageLog(1, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) != 0) {
    }
    glDebugMessageCallback(nullptr, nullptr);
    for (int i = 0; i < 2; ++i) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 7, -1, "the engine's");
    if (work == EngineWork::feedback) {
        glDebugMessageCallback(hear_complaint, &complaints_);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    }
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

UnusualGlState::~UnusualGlState() {
    glDebugMessageCallback(nullptr, nullptr);
    if (work_ == EngineWork::feedback) {
        glEndTransformFeedback();
        glEndQuery(GL_SAMPLES_PASSED);
        glEndQuery(GL_TIME_ELAPSED);
        for (const GLenum target : {GL_PRIMITIVES_GENERATED, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN})
            for (GLuint stream = 0; stream < 4; ++stream) glEndQueryIndexed(target, stream);
    } else {
        glEndQuery(GL_ANY_SAMPLES_PASSED);
    }
    glUseProgram(0);
    glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    glDeleteSamplers(static_cast<GLsizei>(samplers_.size()), samplers_.data());
    glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
    glDeleteFramebuffers(static_cast<GLsizei>(framebuffers_.size()), framebuffers_.data());
    for (const GLuint program : programs_) glDeleteProgram(program);
    glDeleteVertexArrays(1, &vertex_array_);
    glDeleteRenderbuffers(1, &renderbuffer_);
    glDeleteProgramPipelines(1, &pipeline_);
    glDeleteTransformFeedbacks(1, &feedback_);
}

bool UnusualGlState::is_default(EngineWork work, std::string_view name) {
    const auto starts = [name](std::string_view start) { return name.substr(0, start.size()) == start; };
    // One occlusion query runs at a time; a vertex array that reads no integers has none.
    if (starts("ANY_SAMPLES_PASSED_CONSERVATIVE") ||
        starts("VERTEX_ATTRIB_ARRAY_INTEGER") || starts("VERTEX_ATTRIB_ARRAY_LONG") || starts("DEBUG_OUTPUT") ||
        starts("TRANSFORM_FEEDBACK_PAUSED"))
        return true;
    if (work == EngineWork::feedback) return starts("ANY_SAMPLES_PASSED");
    return starts("CURRENT_PROGRAM") || starts("SAMPLES_PASSED") || starts("TIME_ELAPSED") ||
           starts("PRIMITIVES_GENERATED") || starts("TRANSFORM_FEEDBACK_PRIMITIVES") ||
           starts("TRANSFORM_FEEDBACK_ACTIVE") || starts("DEBUG_CALLBACK");
}

GLuint UnusualGlState::buffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferData(name, kBuffer_bytes, nullptr, GL_DYNAMIC_DRAW);
    return buffers_.emplace_back(name);
}

void UnusualGlState::set_modes() {
    for (const GLenum on : {GL_PRIMITIVE_RESTART,
                            GL_PRIMITIVE_RESTART_FIXED_INDEX,
                            GL_DEPTH_CLAMP,
                            GL_RASTERIZER_DISCARD,
                            GL_PROGRAM_POINT_SIZE,
                            GL_LINE_SMOOTH,
                            GL_CULL_FACE,
                            GL_POLYGON_SMOOTH,
                            GL_POLYGON_OFFSET_POINT,
                            GL_POLYGON_OFFSET_LINE,
                            GL_POLYGON_OFFSET_FILL,
                            GL_SAMPLE_ALPHA_TO_COVERAGE,
                            GL_SAMPLE_ALPHA_TO_ONE,
                            GL_SAMPLE_COVERAGE,
                            GL_SAMPLE_SHADING,
                            GL_SAMPLE_MASK,
                            GL_TEXTURE_CUBE_MAP_SEAMLESS,
                            GL_STENCIL_TEST,
                            GL_DEPTH_TEST,
                            GL_FRAMEBUFFER_SRGB,
                            GL_COLOR_LOGIC_OP})
        glEnable(on);
    for (GLenum i = 0; i < 8; ++i) glEnable(GL_CLIP_DISTANCE0 + i);
    glDisable(GL_MULTISAMPLE);
    glDisable(GL_DITHER);
    glPrimitiveRestartIndex(11);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glPointSize(3.0f);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 4.0f);
    glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT);
    glLineWidth(2.0f);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(5.0f, 6.0f);
    glSampleCoverage(0.25f, GL_TRUE);
    glMinSampleShading(0.5f);
    for (GLint word = 0; word < limit(GL_MAX_SAMPLE_MASK_WORDS); ++word)
        glSampleMaski(static_cast<GLuint>(word), 0x55u);
    glStencilFuncSeparate(GL_FRONT, GL_LESS, 3, 0x0f);
    glStencilFuncSeparate(GL_BACK, GL_GREATER, 5, 0xf0);
    glStencilOpSeparate(GL_FRONT, GL_INVERT, GL_INCR, GL_DECR);
    glStencilOpSeparate(GL_BACK, GL_ZERO, GL_REPLACE, GL_INCR_WRAP);
    glStencilMaskSeparate(GL_FRONT, 0x3c);
    glStencilMaskSeparate(GL_BACK, 0xc3);
    glDepthFunc(GL_NOTEQUAL);
    glDepthMask(GL_FALSE);
    glLogicOp(GL_XOR);
    glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
    glClearDepth(0.25);
    glClearStencil(9);
    glBlendColor(0.5f, 0.6f, 0.7f, 0.8f);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    const std::array<GLfloat, 4> levels = {2.0f, 3.0f, 4.0f, 5.0f};
    glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, levels.data());
    glPatchParameterfv(GL_PATCH_DEFAULT_INNER_LEVEL, levels.data());
    for (const GLenum hint :
         {GL_LINE_SMOOTH_HINT, GL_POLYGON_SMOOTH_HINT, GL_TEXTURE_COMPRESSION_HINT, GL_FRAGMENT_SHADER_DERIVATIVE_HINT})
        glHint(hint, GL_NICEST);
}

void UnusualGlState::set_transfer() {
    GLint value = 1;
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH,
                              GL_UNPACK_IMAGE_HEIGHT,
                              GL_UNPACK_SKIP_ROWS,
                              GL_UNPACK_SKIP_PIXELS,
                              GL_UNPACK_SKIP_IMAGES,
                              GL_UNPACK_SWAP_BYTES,
                              GL_UNPACK_LSB_FIRST,
                              GL_UNPACK_COMPRESSED_BLOCK_WIDTH,
                              GL_UNPACK_COMPRESSED_BLOCK_HEIGHT,
                              GL_UNPACK_COMPRESSED_BLOCK_DEPTH,
                              GL_UNPACK_COMPRESSED_BLOCK_SIZE,
                              GL_PACK_ROW_LENGTH,
                              GL_PACK_IMAGE_HEIGHT,
                              GL_PACK_SKIP_ROWS,
                              GL_PACK_SKIP_PIXELS,
                              GL_PACK_SKIP_IMAGES,
                              GL_PACK_SWAP_BYTES,
                              GL_PACK_LSB_FIRST,
                              GL_PACK_COMPRESSED_BLOCK_WIDTH,
                              GL_PACK_COMPRESSED_BLOCK_HEIGHT,
                              GL_PACK_COMPRESSED_BLOCK_DEPTH,
                              GL_PACK_COMPRESSED_BLOCK_SIZE})
        glPixelStorei(name, ++value);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
}

void UnusualGlState::set_indexed() {
    for (GLuint i = 0; i < static_cast<GLuint>(limit(GL_MAX_VIEWPORTS)); ++i) {
        const auto n = static_cast<GLfloat>(i);
        glViewportIndexedf(i, 0.5f + n, 1.0f, 7.0f + n, 8.0f);
        glDepthRangeIndexed(i, 0.75, 0.25 + static_cast<double>(i) / 64.0);
        glScissorIndexed(i, 1, 2, 3, static_cast<GLsizei>(4 + i));
        glEnablei(GL_SCISSOR_TEST, i);
    }
    constexpr std::array<GLenum, 4> factors = {GL_DST_COLOR, GL_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE,
                                               GL_ONE_MINUS_DST_ALPHA};
    for (GLuint i = 0; i < static_cast<GLuint>(limit(GL_MAX_DRAW_BUFFERS)); ++i) {
        glEnablei(GL_BLEND, i);
        glBlendFuncSeparatei(i, factors[i % 4], factors[(i + 1) % 4], factors[(i + 2) % 4], factors[(i + 3) % 4]);
        glBlendEquationSeparatei(i, i % 2 == 0 ? GL_MIN : GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT);
        glColorMaski(i, i % 2 == 0, GL_FALSE, i % 2 == 1, i % 3 == 0);
    }
}

GLuint UnusualGlState::texture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    switch (target) {
        case GL_TEXTURE_1D:
            glTextureStorage1D(name, 1, GL_RGBA8, 4);
            break;
        case GL_TEXTURE_3D:
        case GL_TEXTURE_2D_ARRAY:
            glTextureStorage3D(name, 2, GL_RGBA8, 4, 4, 6);
            break;
        case GL_TEXTURE_CUBE_MAP_ARRAY:
            glTextureStorage3D(name, 1, GL_RGBA8, 4, 4, 6);
            break;
        case GL_TEXTURE_BUFFER:
            glTextureBuffer(name, GL_RGBA8, buffer());
            break;
        case GL_TEXTURE_2D_MULTISAMPLE:
            glTextureStorage2DMultisample(name, 4, GL_RGBA8, 4, 4, GL_TRUE);
            break;
        case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
            glTextureStorage3DMultisample(name, 4, GL_RGBA8, 4, 4, 2, GL_TRUE);
            break;
        default:
            glTextureStorage2D(name, 1, GL_RGBA8, 4, 4);
    }
    return textures_.emplace_back(name);
}

void UnusualGlState::bind_textures() {
    constexpr std::array targets = {GL_TEXTURE_1D,
                                    GL_TEXTURE_2D,
                                    GL_TEXTURE_3D,
                                    GL_TEXTURE_1D_ARRAY,
                                    GL_TEXTURE_2D_ARRAY,
                                    GL_TEXTURE_CUBE_MAP_ARRAY,
                                    GL_TEXTURE_RECTANGLE,
                                    GL_TEXTURE_BUFFER,
                                    GL_TEXTURE_CUBE_MAP,
                                    GL_TEXTURE_2D_MULTISAMPLE,
                                    GL_TEXTURE_2D_MULTISAMPLE_ARRAY};
    std::array<GLuint, 3> samplers{};
    glCreateSamplers(3, samplers.data());
    samplers_.assign(samplers.begin(), samplers.end());
    for (int set = 0; set < 3; ++set)
        for (const GLenum target : targets) texture(target);
    const auto units = static_cast<GLuint>(limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
    for (GLuint unit = 0; unit < units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (std::size_t i = 0; i < targets.size(); ++i)
            glBindTexture(targets[i], textures_[unit % 3 * targets.size() + i]);
        glBindSampler(unit, samplers_[unit % 3]);
    }
    glActiveTexture(GL_TEXTURE0 + 5);
    for (GLuint unit = 0; unit < static_cast<GLuint>(limit(GL_MAX_IMAGE_UNITS)); ++unit)
        glBindImageTexture(unit, textures_[4], 1, GL_TRUE, 3, GL_READ_WRITE, GL_RGBA8);
}

void UnusualGlState::bind_buffers() {
    glCreateTransformFeedbacks(1, &feedback_);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_);
    struct Row {
        GLenum target, limit;
    };
    for (const Row& row : {Row{GL_UNIFORM_BUFFER, GL_MAX_UNIFORM_BUFFER_BINDINGS},
                           Row{GL_SHADER_STORAGE_BUFFER, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS},
                           Row{GL_ATOMIC_COUNTER_BUFFER, GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS},
                           Row{GL_TRANSFORM_FEEDBACK_BUFFER, GL_MAX_TRANSFORM_FEEDBACK_BUFFERS}})
        for (GLuint i = 0; i < static_cast<GLuint>(limit(row.limit)); ++i) {
            // Every third is bound as a whole.
            if (i % 3 == 2)
                glBindBufferBase(row.target, i, buffer());
            else
                glBindBufferRange(row.target, i, buffer(), 256 * static_cast<GLintptr>(1 + i),
                                  512 + 4 * static_cast<GLsizeiptr>(i));
        }
    for (const GLenum target :
         {GL_ARRAY_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_PACK_BUFFER, GL_UNIFORM_BUFFER,
          GL_SHADER_STORAGE_BUFFER, GL_ATOMIC_COUNTER_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER, GL_COPY_READ_BUFFER,
          GL_COPY_WRITE_BUFFER, GL_TEXTURE_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_QUERY_BUFFER})
        glBindBuffer(target, buffer());
}

void UnusualGlState::bind_vertices() {
    glCreateVertexArrays(1, &vertex_array_);
    glBindVertexArray(vertex_array_);
    glVertexArrayElementBuffer(vertex_array_, buffer());
    const auto bindings = static_cast<GLuint>(limit(GL_MAX_VERTEX_ATTRIB_BINDINGS));
    for (GLuint i = 0; i < static_cast<GLuint>(limit(GL_MAX_VERTEX_ATTRIBS)); ++i) {
        glVertexAttribPointer(i, 2, GL_SHORT, GL_TRUE, 24, nullptr);
        glVertexArrayVertexBuffer(vertex_array_, i, buffer(), 16 * static_cast<GLintptr>(1 + i),
                                  12 + 4 * static_cast<GLsizei>(i % 4 + 2));
        glVertexArrayBindingDivisor(vertex_array_, i, 2 + i);
        glVertexArrayAttribFormat(vertex_array_, i, 2, GL_SHORT, GL_TRUE, 4 + i);
        glVertexArrayAttribBinding(vertex_array_, i, (i + 1) % bindings);
        glEnableVertexArrayAttrib(vertex_array_, i);
        glVertexAttrib4f(i, 1.0f + static_cast<float>(i), 2.0f, 3.0f, 4.0f);
    }
}

void UnusualGlState::bind_framebuffers() {
    framebuffers_.resize(2);
    glCreateFramebuffers(2, framebuffers_.data());
    glCreateRenderbuffers(1, &renderbuffer_);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    glNamedRenderbufferStorage(renderbuffer_, GL_DEPTH24_STENCIL8, 4, 4);
    for (const GLuint framebuffer : framebuffers_) {
        glNamedFramebufferRenderbuffer(framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, renderbuffer_);
        std::array<GLenum, 8> points{};
        for (GLenum i = 0; i < points.size(); ++i) points[i] = GL_COLOR_ATTACHMENT0 + (i + 1) % 8;
        glNamedFramebufferTextureLayer(framebuffer, GL_COLOR_ATTACHMENT1, textures_[4], 0, 1);
        glNamedFramebufferDrawBuffers(framebuffer, 8, points.data());
        glNamedFramebufferReadBuffer(framebuffer, GL_COLOR_ATTACHMENT1);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[0]);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
}

void UnusualGlState::use_programs() {
    glCreateProgramPipelines(1, &pipeline_);
    for (const auto& [stage, source] :
         {std::pair{GL_VERTEX_SHADER, kVertex}, std::pair{GL_FRAGMENT_SHADER, kFragment}}) {
        const GLuint program = glCreateShaderProgramv(stage, 1, &source);
        programs_.push_back(program);
        GLint linked = GL_FALSE;
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        EXPECT_EQ(linked, GL_TRUE);
        glUseProgramStages(pipeline_, stage == GL_VERTEX_SHADER ? GL_VERTEX_SHADER_BIT : GL_FRAGMENT_SHADER_BIT,
                           program);
    }
    glBindProgramPipeline(pipeline_);
    if (work_ == EngineWork::pipeline) return choose_second_subroutines();
    const GLuint program = programs_.emplace_back(glCreateProgram());
    for (const auto& [stage, source] :
         {std::pair{GL_VERTEX_SHADER, kVertex}, std::pair{GL_FRAGMENT_SHADER, kFragment}}) {
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &source, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    const char* varying = "written";
    glTransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    glLinkProgram(program);
    glUseProgram(program);
    choose_second_subroutines();
    glBeginTransformFeedback(GL_TRIANGLES);
}

void UnusualGlState::run_queries() {
    const auto query = [this](GLenum target) {
        GLuint name = 0;
        glCreateQueries(target, 1, &name);
        return queries_.emplace_back(name);
    };
    if (work_ == EngineWork::pipeline) return glBeginQuery(GL_ANY_SAMPLES_PASSED, query(GL_ANY_SAMPLES_PASSED));
    glBeginQuery(GL_SAMPLES_PASSED, query(GL_SAMPLES_PASSED));
    glBeginQuery(GL_TIME_ELAPSED, query(GL_TIME_ELAPSED));
    for (const GLenum target : {GL_PRIMITIVES_GENERATED, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN})
        for (GLuint stream = 0; stream < 4; ++stream) glBeginQueryIndexed(target, stream, query(target));
}

}  // namespace gnomon
