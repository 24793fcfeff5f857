#pragma once
#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::gl {

/// Fixed objects and limits for executing lists. Private to the executor.
struct GlFixtures {
    static constexpr GLuint kVertexSlot = 0, kItemSlot = 1;                 // buffers of both
    static constexpr std::size_t kTextureUnits = 32, kBindings = 16;        // most that lists may use
    GLuint mesh_layout = 0;                                                 // vertex array of BindMeshes
    GLuint other_layout = 0;                                                // the same, for a layout of someone else
    GLuint empty_layout = 0;                                                // vertex array of draws without attributes
    GLsizei texture_units = 0, uniform_bindings = 0, storage_bindings = 0;  // available to lists
    std::size_t group_depth = 0, message_bytes = 0;
    std::uint32_t uniform_alignment = 0;
    std::array<GLuint, 2> mark{};  // divisors of two unused attributes of empty_layout, which no other object has
};
GlFixtures make_fixtures();
/// Returns whether the fixtures are of the context that is current. Contexts share neither vertex arrays nor
/// framebuffers, and the same name may be another object in each.
bool is_current(const GlFixtures& fixtures);
void delete_fixtures(const GlFixtures& fixtures);

}  // namespace gnomon::gl
