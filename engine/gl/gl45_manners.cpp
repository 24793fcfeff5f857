#include "engine/gl/gl45_manners.h"

#include <limits>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {
namespace {

constexpr int kMostFlags = 32;  // a lost context may report errors forever

void raise_invalid_operation() {
    GLint size = 0;
    glGetNamedBufferParameteriv(0, GL_BUFFER_SIZE, &size);  // 0 is no buffer
}

void raise_stack_overflow() {
    GLint before = 0, most = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &before);
    glGetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most);
    for (GLint depth = before; depth <= most; ++depth) glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, -1, "full");
    for (GLint depth = before; depth < most; ++depth) glPopDebugGroup();
}

void raise_stack_underflow() {
    GLint depth = 0;
    glGetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
    depth <= 1 ? glPopDebugGroup() : raise_invalid_operation();
}

void raise_out_of_memory() {
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferData(buffer, std::numeric_limits<GLsizeiptr>::max() / 2, nullptr, GL_STATIC_DRAW);
    glDeleteBuffers(1, &buffer);
}

void raise_invalid_framebuffer_operation() {
    GLuint empty = 0;
    glCreateFramebuffers(1, &empty);
    glBlitNamedFramebuffer(empty, empty, 0, 0, 1, 1, 0, 0, 1, 1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glDeleteFramebuffers(1, &empty);
}

void raise(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return glEnable(GL_NONE);
        case GL_INVALID_VALUE:
            return glDeleteBuffers(-1, nullptr);
        case GL_INVALID_OPERATION:
            return raise_invalid_operation();
        case GL_STACK_OVERFLOW:
            return raise_stack_overflow();
        case GL_STACK_UNDERFLOW:
            return raise_stack_underflow();
        case GL_OUT_OF_MEMORY:
            return raise_out_of_memory();
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return raise_invalid_framebuffer_operation();
        default:
            return;  // GL_CONTEXT_LOST comes back by itself
    }
}

constexpr std::array<GLenum, 8> kUnpackModes = {GL_UNPACK_ALIGNMENT,  GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT,
                                                GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES,
                                                GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST};
constexpr std::array<GLenum, 8> kPackModes = {GL_PACK_ALIGNMENT,  GL_PACK_ROW_LENGTH,  GL_PACK_IMAGE_HEIGHT,
                                              GL_PACK_SKIP_ROWS,  GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES,
                                              GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST};

}  // namespace

void PendingErrors::take() {
    for (int i = 0; i < kMostFlags; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR) return;
        if (error >= GL_INVALID_ENUM && error <= GL_CONTEXT_LOST) kinds_ |= 1u << (error - GL_INVALID_ENUM);
    }
}

void PendingErrors::raise_again() const {
    for (GLenum error = GL_INVALID_ENUM; error <= GL_CONTEXT_LOST; ++error)
        if ((kinds_ >> (error - GL_INVALID_ENUM) & 1u) != 0) raise(error);
}

GlCall::GlCall(bool keeps, const GlListener& listener) : keeps_(keeps) {
    if (!keeps_) return;
    errors_.take();
    const bool hears = glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE;
    if (listener.callback == nullptr && !hears) return;
    glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback_);
    if (listener.callback == nullptr) {
        if (callback_ == nullptr) output_.set(false);
        return;
    }
    glGetPointerv(GL_DEBUG_CALLBACK_USER_PARAM, &user_);
    output_.set(true);
    synchronous_.set(true);
    glDebugMessageCallback(listener.callback, listener.user);
    installed_ = true;
}

GlCall::~GlCall() {
    if (!keeps_) return;
    drop_gl_errors();
    if (installed_) glDebugMessageCallback(reinterpret_cast<GLDEBUGPROC>(callback_), user_);
    if (errors_.any()) {
        output_.set(false);  // its callback has heard of them before
        errors_.raise_again();
    }
    synchronous_.restore();
    output_.restore();
}

PixelTransfer::PixelTransfer(bool keeps, Direction direction) {
    if (!keeps) {
        reset_pixel_transfer();
        return;
    }
    const bool upload = direction == Direction::upload;
    upload ? unpack_.set(0) : pack_.set(0);
    modes_ = upload ? &kUnpackModes : &kPackModes;
    for (std::size_t i = 0; i < kModes; ++i) {
        const GLint wanted = i == 0 ? 1 : 0;  // the alignment, in bytes, comes first
        glGetIntegerv((*modes_)[i], &before_[i]);
        if (before_[i] != wanted) glPixelStorei((*modes_)[i], wanted);
    }
}

PixelTransfer::~PixelTransfer() {
    if (modes_ == nullptr) return;
    for (std::size_t i = 0; i < kModes; ++i)
        if (before_[i] != (i == 0 ? 1 : 0)) glPixelStorei((*modes_)[i], before_[i]);
    unpack_.restore();
    pack_.restore();
}

}  // namespace gnomon::gl
