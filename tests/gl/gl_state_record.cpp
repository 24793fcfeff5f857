#include "tests/gl/gl_state_record.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

namespace gnomon {
namespace {

struct Entry {
    const char* name;
    GLenum value;
    std::size_t count = 1;
};
#define GNOMON_GL(name) #name, GL_##name

// The state tables of the specification (chapter 23), in their order.
constexpr Entry kSingle[] = {
    {GNOMON_GL(VERTEX_ARRAY_BINDING)},
    {GNOMON_GL(ARRAY_BUFFER_BINDING)},
    {GNOMON_GL(ELEMENT_ARRAY_BUFFER_BINDING)},
    {GNOMON_GL(DRAW_INDIRECT_BUFFER_BINDING)},
    {GNOMON_GL(PRIMITIVE_RESTART_INDEX)},
    {GNOMON_GL(TRANSFORM_FEEDBACK_BINDING)},
    {GNOMON_GL(CLIP_ORIGIN)},
    {GNOMON_GL(CLIP_DEPTH_MODE)},
    {GNOMON_GL(CLAMP_READ_COLOR)},
    {GNOMON_GL(PROVOKING_VERTEX)},
    {GNOMON_GL(POINT_SIZE)},
    {GNOMON_GL(POINT_FADE_THRESHOLD_SIZE)},
    {GNOMON_GL(POINT_SPRITE_COORD_ORIGIN)},
    {GNOMON_GL(LINE_WIDTH)},
    {GNOMON_GL(CULL_FACE_MODE)},
    {GNOMON_GL(FRONT_FACE)},
    {GNOMON_GL(POLYGON_MODE)},
    {GNOMON_GL(POLYGON_OFFSET_FACTOR)},
    {GNOMON_GL(POLYGON_OFFSET_UNITS)},
    {GNOMON_GL(SAMPLE_COVERAGE_VALUE)},
    {GNOMON_GL(SAMPLE_COVERAGE_INVERT)},
    {GNOMON_GL(MIN_SAMPLE_SHADING_VALUE)},
    {GNOMON_GL(ACTIVE_TEXTURE)},
    {GNOMON_GL(STENCIL_FUNC)},
    {GNOMON_GL(STENCIL_VALUE_MASK)},
    {GNOMON_GL(STENCIL_REF)},
    {GNOMON_GL(STENCIL_FAIL)},
    {GNOMON_GL(STENCIL_PASS_DEPTH_FAIL)},
    {GNOMON_GL(STENCIL_PASS_DEPTH_PASS)},
    {GNOMON_GL(STENCIL_BACK_FUNC)},
    {GNOMON_GL(STENCIL_BACK_VALUE_MASK)},
    {GNOMON_GL(STENCIL_BACK_REF)},
    {GNOMON_GL(STENCIL_BACK_FAIL)},
    {GNOMON_GL(STENCIL_BACK_PASS_DEPTH_FAIL)},
    {GNOMON_GL(STENCIL_BACK_PASS_DEPTH_PASS)},
    {GNOMON_GL(DEPTH_FUNC)},
    {GNOMON_GL(BLEND_COLOR), 4},
    {GNOMON_GL(LOGIC_OP_MODE)},
    {GNOMON_GL(DEPTH_WRITEMASK)},
    {GNOMON_GL(STENCIL_WRITEMASK)},
    {GNOMON_GL(STENCIL_BACK_WRITEMASK)},
    {GNOMON_GL(COLOR_CLEAR_VALUE), 4},
    {GNOMON_GL(DEPTH_CLEAR_VALUE)},
    {GNOMON_GL(STENCIL_CLEAR_VALUE)},
    {GNOMON_GL(DRAW_FRAMEBUFFER_BINDING)},
    {GNOMON_GL(READ_FRAMEBUFFER_BINDING)},
    {GNOMON_GL(RENDERBUFFER_BINDING)},
    {GNOMON_GL(READ_BUFFER)},
    {GNOMON_GL(UNPACK_SWAP_BYTES)},
    {GNOMON_GL(UNPACK_LSB_FIRST)},
    {GNOMON_GL(UNPACK_IMAGE_HEIGHT)},
    {GNOMON_GL(UNPACK_SKIP_IMAGES)},
    {GNOMON_GL(UNPACK_ROW_LENGTH)},
    {GNOMON_GL(UNPACK_SKIP_ROWS)},
    {GNOMON_GL(UNPACK_SKIP_PIXELS)},
    {GNOMON_GL(UNPACK_ALIGNMENT)},
    {GNOMON_GL(UNPACK_COMPRESSED_BLOCK_WIDTH)},
    {GNOMON_GL(UNPACK_COMPRESSED_BLOCK_HEIGHT)},
    {GNOMON_GL(UNPACK_COMPRESSED_BLOCK_DEPTH)},
    {GNOMON_GL(UNPACK_COMPRESSED_BLOCK_SIZE)},
    {GNOMON_GL(PIXEL_UNPACK_BUFFER_BINDING)},
    {GNOMON_GL(PACK_SWAP_BYTES)},
    {GNOMON_GL(PACK_LSB_FIRST)},
    {GNOMON_GL(PACK_IMAGE_HEIGHT)},
    {GNOMON_GL(PACK_SKIP_IMAGES)},
    {GNOMON_GL(PACK_ROW_LENGTH)},
    {GNOMON_GL(PACK_SKIP_ROWS)},
    {GNOMON_GL(PACK_SKIP_PIXELS)},
    {GNOMON_GL(PACK_ALIGNMENT)},
    {GNOMON_GL(PACK_COMPRESSED_BLOCK_WIDTH)},
    {GNOMON_GL(PACK_COMPRESSED_BLOCK_HEIGHT)},
    {GNOMON_GL(PACK_COMPRESSED_BLOCK_DEPTH)},
    {GNOMON_GL(PACK_COMPRESSED_BLOCK_SIZE)},
    {GNOMON_GL(PIXEL_PACK_BUFFER_BINDING)},
    {GNOMON_GL(CURRENT_PROGRAM)},
    {GNOMON_GL(PROGRAM_PIPELINE_BINDING)},
    {GNOMON_GL(PATCH_VERTICES)},
    {GNOMON_GL(PATCH_DEFAULT_OUTER_LEVEL), 4},
    {GNOMON_GL(PATCH_DEFAULT_INNER_LEVEL), 2},
    {GNOMON_GL(UNIFORM_BUFFER_BINDING)},
    {GNOMON_GL(SHADER_STORAGE_BUFFER_BINDING)},
    {GNOMON_GL(ATOMIC_COUNTER_BUFFER_BINDING)},
    {GNOMON_GL(TRANSFORM_FEEDBACK_BUFFER_BINDING)},
    {GNOMON_GL(TRANSFORM_FEEDBACK_ACTIVE)},
    {GNOMON_GL(TRANSFORM_FEEDBACK_PAUSED)},
    {GNOMON_GL(LINE_SMOOTH_HINT)},
    {GNOMON_GL(POLYGON_SMOOTH_HINT)},
    {GNOMON_GL(TEXTURE_COMPRESSION_HINT)},
    {GNOMON_GL(FRAGMENT_SHADER_DERIVATIVE_HINT)},
    {GNOMON_GL(COPY_READ_BUFFER_BINDING)},
    {GNOMON_GL(COPY_WRITE_BUFFER_BINDING)},
    {"TEXTURE_BUFFER_BINDING", GL_TEXTURE_BUFFER_BINDING},
    {GNOMON_GL(DISPATCH_INDIRECT_BUFFER_BINDING)},
    {GNOMON_GL(QUERY_BUFFER_BINDING)},
    // The log is left out: NVIDIA enters each debug group there, with GL_DEBUG_OUTPUT off as well.
    {GNOMON_GL(DEBUG_GROUP_STACK_DEPTH)},
};
constexpr Entry kCapabilities[] = {
    {GNOMON_GL(PRIMITIVE_RESTART)},
    {GNOMON_GL(PRIMITIVE_RESTART_FIXED_INDEX)},
    {GNOMON_GL(CLIP_DISTANCE0)},
    {GNOMON_GL(CLIP_DISTANCE1)},
    {GNOMON_GL(CLIP_DISTANCE2)},
    {GNOMON_GL(CLIP_DISTANCE3)},
    {GNOMON_GL(CLIP_DISTANCE4)},
    {GNOMON_GL(CLIP_DISTANCE5)},
    {GNOMON_GL(CLIP_DISTANCE6)},
    {GNOMON_GL(CLIP_DISTANCE7)},
    {GNOMON_GL(DEPTH_CLAMP)},
    {GNOMON_GL(RASTERIZER_DISCARD)},
    {GNOMON_GL(PROGRAM_POINT_SIZE)},
    {GNOMON_GL(LINE_SMOOTH)},
    {GNOMON_GL(CULL_FACE)},
    {GNOMON_GL(POLYGON_SMOOTH)},
    {GNOMON_GL(POLYGON_OFFSET_POINT)},
    {GNOMON_GL(POLYGON_OFFSET_LINE)},
    {GNOMON_GL(POLYGON_OFFSET_FILL)},
    {GNOMON_GL(MULTISAMPLE)},
    {GNOMON_GL(SAMPLE_ALPHA_TO_COVERAGE)},
    {GNOMON_GL(SAMPLE_ALPHA_TO_ONE)},
    {GNOMON_GL(SAMPLE_COVERAGE)},
    {GNOMON_GL(SAMPLE_SHADING)},
    {GNOMON_GL(SAMPLE_MASK)},
    {GNOMON_GL(TEXTURE_CUBE_MAP_SEAMLESS)},
    {GNOMON_GL(STENCIL_TEST)},
    {GNOMON_GL(DEPTH_TEST)},
    {GNOMON_GL(FRAMEBUFFER_SRGB)},
    {GNOMON_GL(DITHER)},
    {GNOMON_GL(COLOR_LOGIC_OP)},
    {GNOMON_GL(DEBUG_OUTPUT)},
    {GNOMON_GL(DEBUG_OUTPUT_SYNCHRONOUS)},
};
constexpr Entry kPerBuffer[] = {{GNOMON_GL(BLEND_SRC_RGB)},      {GNOMON_GL(BLEND_SRC_ALPHA)},
                                {GNOMON_GL(BLEND_DST_RGB)},      {GNOMON_GL(BLEND_DST_ALPHA)},
                                {GNOMON_GL(BLEND_EQUATION_RGB)}, {GNOMON_GL(BLEND_EQUATION_ALPHA)}};
constexpr Entry kPerUnit[] = {{GNOMON_GL(TEXTURE_BINDING_1D)},
                              {GNOMON_GL(TEXTURE_BINDING_2D)},
                              {GNOMON_GL(TEXTURE_BINDING_3D)},
                              {GNOMON_GL(TEXTURE_BINDING_1D_ARRAY)},
                              {GNOMON_GL(TEXTURE_BINDING_2D_ARRAY)},
                              {GNOMON_GL(TEXTURE_BINDING_CUBE_MAP_ARRAY)},
                              {GNOMON_GL(TEXTURE_BINDING_RECTANGLE)},
                              {GNOMON_GL(TEXTURE_BINDING_BUFFER)},
                              {GNOMON_GL(TEXTURE_BINDING_CUBE_MAP)},
                              {GNOMON_GL(TEXTURE_BINDING_2D_MULTISAMPLE)},
                              {GNOMON_GL(TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY)},
                              {GNOMON_GL(SAMPLER_BINDING)}};
constexpr Entry kPerImage[] = {{GNOMON_GL(IMAGE_BINDING_NAME)},    {GNOMON_GL(IMAGE_BINDING_LEVEL)},
                               {GNOMON_GL(IMAGE_BINDING_LAYERED)}, {GNOMON_GL(IMAGE_BINDING_LAYER)},
                               {GNOMON_GL(IMAGE_BINDING_ACCESS)},  {GNOMON_GL(IMAGE_BINDING_FORMAT)}};
constexpr Entry kPerAttribute[] = {
    {GNOMON_GL(VERTEX_ATTRIB_ARRAY_ENABLED)},        {GNOMON_GL(VERTEX_ATTRIB_ARRAY_SIZE)},
    {GNOMON_GL(VERTEX_ATTRIB_ARRAY_STRIDE)},         {GNOMON_GL(VERTEX_ATTRIB_ARRAY_TYPE)},
    {GNOMON_GL(VERTEX_ATTRIB_ARRAY_NORMALIZED)},     {GNOMON_GL(VERTEX_ATTRIB_ARRAY_INTEGER)},
    {GNOMON_GL(VERTEX_ATTRIB_ARRAY_LONG)},           {GNOMON_GL(VERTEX_ATTRIB_ARRAY_DIVISOR)},
    {GNOMON_GL(VERTEX_ATTRIB_ARRAY_BUFFER_BINDING)}, {GNOMON_GL(VERTEX_ATTRIB_BINDING)},
    {GNOMON_GL(VERTEX_ATTRIB_RELATIVE_OFFSET)}};
constexpr Entry kPerVertexBinding[] = {{GNOMON_GL(VERTEX_BINDING_OFFSET)},
                                       {GNOMON_GL(VERTEX_BINDING_STRIDE)},
                                       {GNOMON_GL(VERTEX_BINDING_DIVISOR)},
                                       {GNOMON_GL(VERTEX_BINDING_BUFFER)}};
struct BufferRow {
    const char* name;
    GLenum limit, binding, start, size;
};
constexpr BufferRow kIndexedBuffers[] = {
    {"UNIFORM_BUFFER", GL_MAX_UNIFORM_BUFFER_BINDINGS, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
     GL_UNIFORM_BUFFER_SIZE},
    {"SHADER_STORAGE_BUFFER", GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, GL_SHADER_STORAGE_BUFFER_BINDING,
     GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE},
    {"ATOMIC_COUNTER_BUFFER", GL_MAX_ATOMIC_COUNTER_BUFFER_BINDINGS, GL_ATOMIC_COUNTER_BUFFER_BINDING,
     GL_ATOMIC_COUNTER_BUFFER_START, GL_ATOMIC_COUNTER_BUFFER_SIZE},
    {"TRANSFORM_FEEDBACK_BUFFER", GL_MAX_TRANSFORM_FEEDBACK_BUFFERS, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
     GL_TRANSFORM_FEEDBACK_BUFFER_START, GL_TRANSFORM_FEEDBACK_BUFFER_SIZE}};
constexpr Entry kQueries[] = {{GNOMON_GL(SAMPLES_PASSED)},
                              {GNOMON_GL(ANY_SAMPLES_PASSED)},
                              {GNOMON_GL(ANY_SAMPLES_PASSED_CONSERVATIVE)},
                              {GNOMON_GL(TIME_ELAPSED)}};
constexpr Entry kStreamQueries[] = {{GNOMON_GL(PRIMITIVES_GENERATED)},
                                    {GNOMON_GL(TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN)}};
struct StageEntry {
    const char* name;
    GLenum value, subroutines;
};
constexpr StageEntry kStages[] = {{GNOMON_GL(VERTEX_SHADER), GL_VERTEX_SUBROUTINE_UNIFORM},
                                  {GNOMON_GL(TESS_CONTROL_SHADER), GL_TESS_CONTROL_SUBROUTINE_UNIFORM},
                                  {GNOMON_GL(TESS_EVALUATION_SHADER), GL_TESS_EVALUATION_SUBROUTINE_UNIFORM},
                                  {GNOMON_GL(GEOMETRY_SHADER), GL_GEOMETRY_SUBROUTINE_UNIFORM},
                                  {GNOMON_GL(FRAGMENT_SHADER), GL_FRAGMENT_SUBROUTINE_UNIFORM},
                                  {GNOMON_GL(COMPUTE_SHADER), GL_COMPUTE_SUBROUTINE_UNIFORM}};
#undef GNOMON_GL

GLint integer(GLenum name) {
    std::array<GLint, 4> value{};
    glGetIntegerv(name, value.data());
    return value[0];
}

class Recorder {
public:
    GlStateRecord run() {
        for (const Entry& entry : kSingle) {
            std::array<double, 16> values{};
            glGetDoublev(entry.value, values.data());
            out_[entry.name].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(entry.count));
        }
        for (const Entry& entry : kCapabilities) put(entry.name, glIsEnabled(entry.value));
        record_viewports();
        record_draw_buffers();
        record_units();
        record_buffers();
        record_vertices();
        record_queries();
        record_programs();
        record_debug();
        return std::move(out_);
    }

private:
    template <class Value>
    void put(const std::string& name, Value value) {
        out_[name].push_back(static_cast<double>(value));
    }
    static std::string at(const char* name, GLint index) {
        return std::string(name) + '[' + std::to_string(index) + ']';
    }
    void put_indexed(const Entry& entry, GLint index) {
        std::array<GLint, 4> values{};
        glGetIntegeri_v(entry.value, static_cast<GLuint>(index), values.data());
        put(at(entry.name, index), values[0]);
    }

    void record_viewports() {
        for (GLint i = 0; i < integer(GL_MAX_VIEWPORTS); ++i) {
            const auto index = static_cast<GLuint>(i);
            std::array<GLfloat, 4> viewport{};
            std::array<GLdouble, 2> depths{};
            std::array<GLint, 4> box{};
            glGetFloati_v(GL_VIEWPORT, index, viewport.data());
            glGetDoublei_v(GL_DEPTH_RANGE, index, depths.data());
            glGetIntegeri_v(GL_SCISSOR_BOX, index, box.data());
            for (const GLfloat value : viewport) put(at("VIEWPORT", i), value);
            for (const GLdouble value : depths) put(at("DEPTH_RANGE", i), value);
            for (const GLint value : box) put(at("SCISSOR_BOX", i), value);
            put(at("SCISSOR_TEST", i), glIsEnabledi(GL_SCISSOR_TEST, index));
        }
        for (GLint i = 0; i < integer(GL_MAX_SAMPLE_MASK_WORDS); ++i)
            put_indexed({"SAMPLE_MASK_VALUE", GL_SAMPLE_MASK_VALUE}, i);
    }
    void record_draw_buffers() {
        for (GLint i = 0; i < integer(GL_MAX_DRAW_BUFFERS); ++i) {
            const auto index = static_cast<GLuint>(i);
            for (const Entry& entry : kPerBuffer) put_indexed(entry, i);
            put(at("BLEND", i), glIsEnabledi(GL_BLEND, index));
            std::array<GLboolean, 4> mask{};
            glGetBooleani_v(GL_COLOR_WRITEMASK, index, mask.data());
            for (const GLboolean value : mask) put(at("COLOR_WRITEMASK", i), value);
            put(at("DRAW_BUFFER", i), integer(GL_DRAW_BUFFER0 + index));
        }
    }
    void record_units() {
        const GLint active = integer(GL_ACTIVE_TEXTURE);
        for (GLint i = 0; i < integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS); ++i) {
            glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
            for (const Entry& entry : kPerUnit) put(at(entry.name, i), integer(entry.value));
        }
        glActiveTexture(static_cast<GLenum>(active));
        for (GLint i = 0; i < integer(GL_MAX_IMAGE_UNITS); ++i)
            for (const Entry& entry : kPerImage) put_indexed(entry, i);
    }
    void record_buffers() {
        for (const BufferRow& row : kIndexedBuffers)
            for (GLint i = 0; i < integer(row.limit); ++i) {
                put_indexed({row.name, row.binding}, i);
                for (const GLenum what : {row.start, row.size}) {
                    GLint64 value = 0;
                    glGetInteger64i_v(what, static_cast<GLuint>(i), &value);
                    put(at(row.name, i), value);
                }
            }
    }
    void record_vertices() {
        for (GLint i = 0; i < integer(GL_MAX_VERTEX_ATTRIBS); ++i) {
            const auto index = static_cast<GLuint>(i);
            std::array<GLfloat, 4> current{};
            glGetVertexAttribfv(index, GL_CURRENT_VERTEX_ATTRIB, current.data());
            for (const GLfloat value : current) put(at("CURRENT_VERTEX_ATTRIB", i), value);
            for (const Entry& entry : kPerAttribute) {
                GLint value = 0;
                glGetVertexAttribiv(index, entry.value, &value);
                put(at(entry.name, i), value);
            }
        }
        for (GLint i = 0; i < integer(GL_MAX_VERTEX_ATTRIB_BINDINGS); ++i)
            for (const Entry& entry : kPerVertexBinding) put_indexed(entry, i);
    }
    void record_queries() {
        GLint value = 0;
        for (const Entry& entry : kQueries) {
            glGetQueryiv(entry.value, GL_CURRENT_QUERY, &value);
            put(entry.name, value);
        }
        for (const Entry& entry : kStreamQueries)
            for (GLint i = 0; i < integer(GL_MAX_VERTEX_STREAMS); ++i) {
                glGetQueryIndexediv(entry.value, static_cast<GLuint>(i), GL_CURRENT_QUERY, &value);
                put(at(entry.name, i), value);
            }
    }
    void record_programs() {
        const GLint program = integer(GL_CURRENT_PROGRAM), pipeline = integer(GL_PROGRAM_PIPELINE_BINDING);
        for (const StageEntry& stage : kStages) {
            GLint used = program, locations = 0;
            if (program == 0 && pipeline != 0)
                glGetProgramPipelineiv(static_cast<GLuint>(pipeline), stage.value, &used);
            GLint uniforms = 0;
            if (used != 0)
                glGetProgramInterfaceiv(static_cast<GLuint>(used), stage.subroutines, GL_ACTIVE_RESOURCES, &uniforms);
            if (uniforms == 0) continue;  // the query below is an error for stages that are missing
            glGetProgramStageiv(static_cast<GLuint>(used), stage.value, GL_ACTIVE_SUBROUTINE_UNIFORM_LOCATIONS,
                                &locations);
            for (GLint i = 0; i < locations; ++i) {
                GLuint chosen = 0;
                glGetUniformSubroutineuiv(stage.value, i, &chosen);
                put(std::string("SUBROUTINE ") + at(stage.name, i), chosen);
            }
        }
    }
    void record_debug() {
        for (const GLenum what : {GL_DEBUG_CALLBACK_FUNCTION, GL_DEBUG_CALLBACK_USER_PARAM}) {
            void* pointer = nullptr;
            glGetPointerv(what, &pointer);
            put(what == GL_DEBUG_CALLBACK_FUNCTION ? "DEBUG_CALLBACK_FUNCTION" : "DEBUG_CALLBACK_USER_PARAM",
                reinterpret_cast<std::uintptr_t>(pointer));
        }
    }

    GlStateRecord out_;
};

std::string text_of(const std::vector<double>& values) {
    std::ostringstream text;
    for (const double value : values) text << ' ' << value;
    return text.str();
}

}  // namespace

GlStateRecord record_gl_state() { return Recorder().run(); }

std::vector<std::string> differences(const GlStateRecord& before, const GlStateRecord& after) {
    std::vector<std::string> found;
    for (const auto& [name, value] : before) {
        const auto other = after.find(name);
        if (other == after.end())
            found.push_back(name + " is gone");
        else if (other->second != value)
            found.push_back(name + ":" + text_of(value) + " ->" + text_of(other->second));
    }
    for (const auto& [name, value] : after)
        if (!before.contains(name)) found.push_back(name + " came");
    return found;
}

}  // namespace gnomon
