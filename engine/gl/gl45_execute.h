#pragma once
#include "engine/gl/gl45_objects.h"
#include "engine/gl/gl45_readbacks.h"
#include "engine/gl/gl45_timers.h"

namespace gnomon::gl {

/// Fixed objects and limits for executing lists. Private to the executor.
struct GlFixtures {
    static constexpr GLuint kVertexSlot = 0, kItemSlot = 1;                 // buffers of mesh_layout
    GLuint mesh_layout = 0;                                                 // vertex array of BindMeshes
    GLuint empty_layout = 0;                                                // vertex array of draws without attributes
    GLsizei texture_units = 0, uniform_bindings = 0, storage_bindings = 0;  // available to lists
    std::size_t group_depth = 0, message_bytes = 0;
    std::uint32_t uniform_alignment = 0;
};
GlFixtures make_fixtures();
void delete_fixtures(const GlFixtures& fixtures);

/// Executes a list from a defined state. Leaves no program, texture, buffer or target bound. Skips misused commands and
/// then returns invalid_value.
Failure execute(const CommandList& list, std::uint64_t submission, const GlObjects& objects, const GlFixtures& fixtures,
                GlTimers& timers, GlReadbacks& readbacks);

}  // namespace gnomon::gl
