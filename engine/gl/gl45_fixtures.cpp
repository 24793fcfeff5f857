#include "engine/gl/gl45_fixtures.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {
namespace {

constexpr GLuint kNormalOffset = 3 * sizeof(float), kUvOffset = 6 * sizeof(float);
constexpr GLint kUsedTextureUnits = GlFixtures::kTextureUnits, kUsedBindings = GlFixtures::kBindings;

GLint get_integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

constexpr GLuint kFirstMark = 14;  // attributes that OpenGL guarantees, and no list uses

/// Returns numbers that no other fixtures of the process have: of the time, and of a place in memory.
std::array<GLuint, 2> new_mark(const GlFixtures& fixtures) {
    const auto time = std::chrono::steady_clock::now().time_since_epoch().count();
    const std::uint64_t place = std::hash<const void*>{}(&fixtures);
    std::seed_seq seed{static_cast<std::uint64_t>(time) >> 32, static_cast<std::uint64_t>(time), place >> 32, place};
    std::array<GLuint, 2> mark{};
    seed.generate(mark.begin(), mark.end());
    return mark;
}

}  // namespace

bool is_current(const GlFixtures& fixtures) {
    if (glIsVertexArray(fixtures.empty_layout) == GL_FALSE) return false;
    std::array<GLuint, 2> found{};
    for (GLuint i = 0; i < found.size(); ++i) {
        GLint divisor = 0;
        glGetVertexArrayIndexediv(fixtures.empty_layout, kFirstMark + i, GL_VERTEX_ATTRIB_ARRAY_DIVISOR, &divisor);
        found[i] = static_cast<GLuint>(divisor);
    }
    return found == fixtures.mark;
}

GlFixtures make_fixtures() {
    GlFixtures fixtures;
    glCreateVertexArrays(1, &fixtures.empty_layout);
    fixtures.mark = new_mark(fixtures);
    for (GLuint i = 0; i < fixtures.mark.size(); ++i)
        glVertexArrayBindingDivisor(fixtures.empty_layout, kFirstMark + i, fixtures.mark[i]);
    glCreateVertexArrays(1, &fixtures.mesh_layout);
    const GLuint layout = fixtures.mesh_layout;
    glVertexArrayAttribFormat(layout, kPositionAttribute, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribFormat(layout, kNormalAttribute, 3, GL_FLOAT, GL_FALSE, kNormalOffset);
    glVertexArrayAttribFormat(layout, kUvAttribute, 2, GL_FLOAT, GL_FALSE, kUvOffset);
    glVertexArrayAttribIFormat(layout, kDrawItemAttribute, 2, GL_UNSIGNED_INT, 0);
    for (const GLuint attribute : {kPositionAttribute, kNormalAttribute, kUvAttribute, kDrawItemAttribute}) {
        glEnableVertexArrayAttrib(layout, attribute);
        glVertexArrayAttribBinding(layout, attribute,
                                   attribute == kDrawItemAttribute ? GlFixtures::kItemSlot : GlFixtures::kVertexSlot);
    }
    glVertexArrayBindingDivisor(layout, GlFixtures::kItemSlot, 1);
    glCreateVertexArrays(1, &fixtures.other_layout);
    glVertexArrayAttribIFormat(fixtures.other_layout, kDrawItemAttribute, 2, GL_UNSIGNED_INT, 0);
    for (const GLuint attribute : {kPositionAttribute, kDrawItemAttribute}) {
        glEnableVertexArrayAttrib(fixtures.other_layout, attribute);
        glVertexArrayAttribBinding(fixtures.other_layout, attribute,
                                   attribute == kDrawItemAttribute ? GlFixtures::kItemSlot : GlFixtures::kVertexSlot);
    }
    glVertexArrayBindingDivisor(fixtures.other_layout, GlFixtures::kItemSlot, 1);
    set_gl_label(GL_VERTEX_ARRAY, fixtures.mesh_layout, "mesh layout");
    set_gl_label(GL_VERTEX_ARRAY, fixtures.other_layout, "other layout");
    set_gl_label(GL_VERTEX_ARRAY, fixtures.empty_layout, "empty layout");
    fixtures.texture_units = std::min(get_integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS), kUsedTextureUnits);
    fixtures.uniform_bindings = std::min(get_integer(GL_MAX_UNIFORM_BUFFER_BINDINGS), kUsedBindings);
    fixtures.storage_bindings = std::min(get_integer(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS), kUsedBindings);
    fixtures.group_depth = static_cast<std::size_t>(std::max(get_integer(GL_MAX_DEBUG_GROUP_STACK_DEPTH) - 1, 0));
    fixtures.message_bytes = static_cast<std::size_t>(std::max(get_integer(GL_MAX_DEBUG_MESSAGE_LENGTH) - 1, 0));
    fixtures.uniform_alignment = static_cast<std::uint32_t>(get_integer(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT));
    return fixtures;
}

void delete_fixtures(const GlFixtures& fixtures) {
    glDeleteVertexArrays(1, &fixtures.mesh_layout);
    glDeleteVertexArrays(1, &fixtures.other_layout);
    glDeleteVertexArrays(1, &fixtures.empty_layout);
}

}  // namespace gnomon::gl
