#include "tests/gl/failing_gl.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr std::size_t kFaults = 7;

/// What C's function pointers cannot carry with them.
struct State {
    GlFault fault = GlFault::null_map;
    std::uint64_t first = 0, last = 0;  // calls that fail: [first, last)
    std::array<std::uint64_t, kFaults> calls{};
    GLenum error = GL_NO_ERROR;  // left by a fault, until get_error()
    bool lost = false;
    std::int64_t live_names = 0;
    std::vector<void (*)()> undo;  // restores each entry of the table
};
State state;

bool strikes(GlFault fault) {
    const std::uint64_t call = state.calls[static_cast<std::size_t>(fault)]++;
    return fault == state.fault && call >= state.first && call < state.last;
}

std::int64_t names_in(GLsizei count, const GLuint* names) {
    return std::count_if(names, names + count, [](GLuint name) { return name != 0; });
}

template <auto Slot>
struct Hook;
/// One entry of the table: the driver's function, and what stands in for it.
template <class R, class... A, R (**Slot)(A...)>
struct Hook<Slot> {
    static inline R (*driver)(A...) = nullptr;
    static void put(R (*stand_in)(A...)) {
        driver = *Slot;
        *Slot = stand_in;
        state.undo.push_back([] { *Slot = driver; });
    }

    /// Takes memory or draws: does nothing and leaves an error when struck.
    static R fallible(A... arguments) {
        const bool memory = strikes(GlFault::out_of_memory), value = strikes(GlFault::invalid_value);
        if (!memory && !value) return driver(arguments...);
        state.error = memory ? GL_OUT_OF_MEMORY : GL_INVALID_VALUE;
    }
    static R null_map(A... arguments) { return strikes(GlFault::null_map) ? nullptr : driver(arguments...); }
};

GLenum get_error() {
    const GLenum own = std::exchange(state.error, GLenum{GL_NO_ERROR});
    return own == GL_NO_ERROR ? Hook<&epoxy_glGetError>::driver() : own;
}
GLenum reset_status() {
    state.lost = strikes(GlFault::context_lost) || state.lost;
    return state.lost ? GL_GUILTY_CONTEXT_RESET : Hook<&epoxy_glGetGraphicsResetStatus>::driver();
}
GLenum framebuffer_status(GLuint framebuffer, GLenum target) {
    return strikes(GlFault::incomplete_target)
               ? GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT
               : Hook<&epoxy_glCheckNamedFramebufferStatus>::driver(framebuffer, target);
}
void shader_value(GLuint shader, GLenum name, GLint* value) {
    Hook<&epoxy_glGetShaderiv>::driver(shader, name, value);
    if (name == GL_COMPILE_STATUS && strikes(GlFault::compile_failed)) *value = GL_FALSE;
}
void program_value(GLuint program, GLenum name, GLint* value) {
    Hook<&epoxy_glGetProgramiv>::driver(program, name, value);
    if (name == GL_LINK_STATUS && strikes(GlFault::link_failed)) *value = GL_FALSE;
}

template <auto Slot>
void create(GLsizei count, GLuint* names) {
    Hook<Slot>::driver(count, names);
    state.live_names += names_in(count, names);
}
template <auto Slot>
void create_of_kind(GLenum kind, GLsizei count, GLuint* names) {
    Hook<Slot>::driver(kind, count, names);
    state.live_names += names_in(count, names);
}
template <auto Slot>
void remove(GLsizei count, const GLuint* names) {
    state.live_names -= names_in(count, names);
    Hook<Slot>::driver(count, names);
}
template <auto Slot>
void remove_one(GLuint name) {
    state.live_names -= name != 0;
    Hook<Slot>::driver(name);
}
GLuint create_shader(GLenum kind) {
    const GLuint name = Hook<&epoxy_glCreateShader>::driver(kind);
    state.live_names += name != 0;
    return name;
}
GLuint create_program() {
    const GLuint name = Hook<&epoxy_glCreateProgram>::driver();
    state.live_names += name != 0;
    return name;
}

GLsync fence_sync(GLenum condition, GLbitfield flags) {
    if (strikes(GlFault::out_of_memory)) {
        state.error = GL_OUT_OF_MEMORY;
        return nullptr;
    }
    state.live_names += 1;
    return Hook<&epoxy_glFenceSync>::driver(condition, flags);
}
void delete_sync(GLsync sync) {
    state.live_names -= sync != nullptr;
    Hook<&epoxy_glDeleteSync>::driver(sync);
}
GLenum wait_sync(GLsync sync, GLbitfield flags, GLuint64 timeout_ns) {
    const bool fails = sync == nullptr || strikes(GlFault::invalid_value);
    return fails ? GL_WAIT_FAILED : Hook<&epoxy_glClientWaitSync>::driver(sync, flags, timeout_ns);
}

template <auto... Slots>
void make_fallible() {
    (Hook<Slots>::put(&Hook<Slots>::fallible), ...);
}
template <auto... Slots>
void make_unmappable() {
    (Hook<Slots>::put(&Hook<Slots>::null_map), ...);
}
template <auto... Slots>
void count_created() {
    (Hook<Slots>::put(&create<Slots>), ...);
}
template <auto... Slots>
void count_deleted() {
    (Hook<Slots>::put(&remove<Slots>), ...);
}

/// Calls functions that a device may not have called yet: the loader's table is filled by first calls.
void call_once() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    glDeleteSync(fence);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 4, nullptr, GL_DYNAMIC_STORAGE_BIT | GL_MAP_WRITE_BIT);
    glNamedBufferSubData(buffer, 0, 4, &buffer);
    GLuint anew = 0;
    glCreateBuffers(1, &anew);
    glNamedBufferData(anew, 4, nullptr, GL_STREAM_DRAW);
    glDeleteBuffers(1, &anew);
    glMapNamedBufferRange(buffer, 0, 4, GL_MAP_WRITE_BIT);
    glDeleteBuffers(1, &buffer);
    glDeleteShader(0);
    glDeleteProgram(0);
    glDeleteQueries(0, nullptr);
    glDeleteTextures(0, nullptr);
    glDeleteFramebuffers(0, nullptr);
    glDeleteSamplers(0, nullptr);
    glDeleteVertexArrays(0, nullptr);
}

}  // namespace

const char* to_text(GlFault fault) {
    switch (fault) {
        case GlFault::out_of_memory:
            return "out_of_memory";
        case GlFault::invalid_value:
            return "invalid_value";
        case GlFault::incomplete_target:
            return "incomplete_target";
        case GlFault::compile_failed:
            return "compile_failed";
        case GlFault::link_failed:
            return "link_failed";
        case GlFault::null_map:
            return "null_map";
        case GlFault::context_lost:
            return "context_lost";
    }
    return "?";
}

FailingGl::FailingGl() {
    call_once();
    state = {};
    make_fallible<&epoxy_glTextureStorage2D, &epoxy_glTextureStorage3D, &epoxy_glNamedBufferStorage,
                  &epoxy_glNamedBufferData, &epoxy_glTextureSubImage2D, &epoxy_glGenerateTextureMipmap,
                  &epoxy_glClearNamedBufferData, &epoxy_glNamedBufferSubData, &epoxy_glClearBufferfv,
                  &epoxy_glDrawArrays, &epoxy_glDrawElementsInstancedBaseVertexBaseInstance,
                  &epoxy_glMultiDrawElementsIndirect, &epoxy_glGetTextureSubImage, &epoxy_glDispatchCompute,
                  &epoxy_glCopyNamedBufferSubData, &epoxy_glCopyImageSubData, &epoxy_glGetNamedBufferSubData>();
    make_unmappable<&epoxy_glMapBuffer, &epoxy_glMapBufferRange, &epoxy_glMapNamedBuffer,
                    &epoxy_glMapNamedBufferRange>();
    count_created<&epoxy_glCreateBuffers, &epoxy_glCreateFramebuffers, &epoxy_glCreateSamplers,
                  &epoxy_glCreateVertexArrays>();
    count_deleted<&epoxy_glDeleteTextures, &epoxy_glDeleteBuffers, &epoxy_glDeleteFramebuffers, &epoxy_glDeleteSamplers,
                  &epoxy_glDeleteVertexArrays, &epoxy_glDeleteQueries>();
    Hook<&epoxy_glFenceSync>::put(fence_sync);
    Hook<&epoxy_glDeleteSync>::put(delete_sync);
    Hook<&epoxy_glClientWaitSync>::put(wait_sync);
    Hook<&epoxy_glGetError>::put(get_error);
    Hook<&epoxy_glGetGraphicsResetStatus>::put(reset_status);
    Hook<&epoxy_glCheckNamedFramebufferStatus>::put(framebuffer_status);
    Hook<&epoxy_glGetShaderiv>::put(shader_value);
    Hook<&epoxy_glGetProgramiv>::put(program_value);
    Hook<&epoxy_glCreateTextures>::put(create_of_kind<&epoxy_glCreateTextures>);
    Hook<&epoxy_glCreateQueries>::put(create_of_kind<&epoxy_glCreateQueries>);
    Hook<&epoxy_glCreateShader>::put(create_shader);
    Hook<&epoxy_glCreateProgram>::put(create_program);
    Hook<&epoxy_glDeleteShader>::put(remove_one<&epoxy_glDeleteShader>);
    Hook<&epoxy_glDeleteProgram>::put(remove_one<&epoxy_glDeleteProgram>);
}

FailingGl::~FailingGl() {
    for (void (*const undo)() : state.undo) undo();
}

void FailingGl::begin(GlFault fault, std::uint64_t call, bool lasting) {
    constexpr std::uint64_t never = std::numeric_limits<std::uint64_t>::max();
    state.fault = fault;
    state.first = call;
    state.last = lasting ? never : call == never ? never : call + 1;
    state.calls = {};
    state.error = GL_NO_ERROR;
    state.lost = false;
}
void FailingGl::end() { state.last = state.first = 0; }
std::uint64_t FailingGl::calls(GlFault fault) const { return state.calls[static_cast<std::size_t>(fault)]; }
std::int64_t FailingGl::live_names() const { return state.live_names; }

}  // namespace gnomon
