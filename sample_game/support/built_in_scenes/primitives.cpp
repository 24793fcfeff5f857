#include "sample_game/support/built_in_scenes/primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

#include "sample_game/support/built_in_scenes/ear_clipping.h"

namespace gnomon::game {
namespace {

constexpr double kTurn = 2.0 * glm::pi<double>();

std::uint32_t add_vertex(Shape& shape, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv) {
    shape.positions.emplace_back(position);
    shape.normals.emplace_back(normal);
    shape.uvs.emplace_back(uv);
    return static_cast<std::uint32_t>(shape.positions.size()) - 1u;
}

/// Adds a quad. Its corners are counter-clockwise, seen from the side that `normal` points to.
void add_quad(Shape& shape, const std::array<glm::dvec3, 4>& corners, const glm::dvec3& normal,
              const std::array<glm::dvec2, 4>& uvs) {
    const std::uint32_t first = static_cast<std::uint32_t>(shape.positions.size());
    for (std::size_t i = 0; i < 4; ++i) add_vertex(shape, corners[i], normal, uvs[i]);
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) shape.indices.push_back(first + i);
}

/// Returns point i of a unit circle. Point `count` is the first one to the bit, so that the seam welds exactly.
glm::dvec2 circle_point(std::uint32_t i, std::uint32_t count) {
    const double angle = kTurn * (i % count) / count;
    return {std::cos(angle), -std::sin(angle)};
}

glm::dvec3 turned(const glm::dvec2& radius_height, const glm::dvec2& direction) {
    return {radius_height.x * direction.x, radius_height.y, radius_height.x * direction.y};
}

/// Returns the outward normal of the outline piece a -> b, in (radius, height).
glm::dvec2 outline_normal(const glm::dvec2& a, const glm::dvec2& b) {
    return glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
}

void add_lathe_band(Shape& shape, const std::array<glm::dvec2, 2>& ends, const std::array<glm::dvec2, 2>& normals,
                    std::uint32_t sides) {
    const double length = glm::length(ends[1] - ends[0]);
    const double girth = kTurn * std::max(ends[0].x, ends[1].x);
    const std::uint32_t first = static_cast<std::uint32_t>(shape.positions.size());
    for (std::uint32_t i = 0; i <= sides; ++i) {
        const glm::dvec2 direction = circle_point(i, sides);
        for (std::size_t end = 0; end < 2; ++end) {
            const glm::dvec2 uv(girth * i / sides, end == 0 ? length : 0.0);
            add_vertex(shape, turned(ends[end], direction), turned(normals[end], direction), uv);
        }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t low = first + 2u * i, next_low = low + 2u;
        if (ends[0].x > 0.0) shape.indices.insert(shape.indices.end(), {low, next_low, low + 1u});
        if (ends[1].x > 0.0) shape.indices.insert(shape.indices.end(), {next_low, next_low + 1u, low + 1u});
    }
}

}  // namespace

Shape make_box(const glm::dvec3& min, const glm::dvec3& max) {
    Shape shape;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const glm::length_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const bool positive : {false, true}) {
            glm::dvec3 normal(0.0);
            normal[axis] = positive ? 1.0 : -1.0;
            std::array<glm::dvec3, 4> corners;
            std::array<glm::dvec2, 4> uvs;
            for (std::size_t i = 0; i < 4; ++i) {
                const std::size_t turn = positive ? i : 3u - i;
                glm::dvec3 corner;
                corner[axis] = positive ? max[axis] : min[axis];
                corner[u] = turn == 1 || turn == 2 ? max[u] : min[u];
                corner[v] = turn >= 2 ? max[v] : min[v];
                corners[i] = corner;
                uvs[i] = {corner[u], -corner[v]};
            }
            add_quad(shape, corners, normal, uvs);
        }
    }
    return shape;
}

Shape make_extrusion(std::span<const glm::dvec2> profile, double depth) {
    Shape shape;
    const double half = 0.5 * depth;
    for (const bool front : {true, false}) {
        const std::uint32_t first = static_cast<std::uint32_t>(shape.positions.size());
        for (const glm::dvec2& p : profile)
            add_vertex(shape, {p, front ? half : -half}, {0.0, 0.0, front ? 1.0 : -1.0}, {p.x, -p.y});
        for (const auto& t : triangulate(profile)) {
            const std::array<std::uint32_t, 3> order{t[0], front ? t[1] : t[2], front ? t[2] : t[1]};
            for (const std::uint32_t i : order) shape.indices.push_back(first + i);
        }
    }
    double along = 0.0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const glm::dvec2 p = profile[i], q = profile[(i + 1) % profile.size()];
        const glm::dvec2 out = outline_normal(p, q);
        const double next = along + glm::length(q - p);
        add_quad(shape, {glm::dvec3(p, half), {p, -half}, {q, -half}, {q, half}}, {out, 0.0},
                 {glm::dvec2(along, half), {along, -half}, {next, -half}, {next, half}});
        along = next;
    }
    return shape;
}

Shape make_lathe(std::span<const glm::dvec2> outline, std::uint32_t sides, LatheNormals normals) {
    Shape shape;
    const std::size_t last = outline.size() - 1;
    const auto smooth_normal = [&](std::size_t i) {
        if (i == 0) return glm::dvec2(0.0, -1.0);
        if (i == last) return glm::dvec2(0.0, 1.0);
        return outline_normal(outline[i - 1], outline[i + 1]);
    };
    for (std::size_t i = 0; i < last; ++i) {
        const glm::dvec2 flat = outline_normal(outline[i], outline[i + 1]);
        const bool smooth = normals == LatheNormals::smooth;
        add_lathe_band(shape, {outline[i], outline[i + 1]},
                       {smooth ? smooth_normal(i) : flat, smooth ? smooth_normal(i + 1) : flat}, sides);
    }
    return shape;
}

Shape make_sphere(double radius, std::uint32_t sides, std::uint32_t rings) {
    std::vector<glm::dvec2> outline;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        const double angle = glm::pi<double>() * i / rings;
        const bool pole = i == 0 || i == rings;
        outline.emplace_back(pole ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
    }
    return make_lathe(outline, sides, LatheNormals::smooth);
}

Shape make_bar(const glm::dvec3& from, const glm::dvec3& to, double radius, std::uint32_t sides) {
    const double length = glm::length(to - from);
    const std::array<glm::dvec2, 4> outline{glm::dvec2(0.0, 0.0), {radius, 0.0}, {radius, length}, {0.0, length}};
    const glm::dvec3 up = (to - from) / length;
    const glm::dvec3 helper = std::abs(up.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, helper));
    const glm::dmat4 place(glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(glm::cross(right, up), 0.0),
                           glm::dvec4(from, 1.0));
    Shape bar;
    append(bar, make_lathe(outline, sides, LatheNormals::creased), place);
    return bar;
}

Shape make_ring(double radius, double bar_radius, std::uint32_t segments, std::uint32_t sides) {
    Shape shape;
    for (std::uint32_t i = 0; i < segments; ++i) {
        const glm::dvec2 direction = circle_point(i, segments);
        for (std::uint32_t j = 0; j < sides; ++j) {
            const double angle = kTurn * j / sides;
            const glm::dvec2 out(std::cos(angle), std::sin(angle));
            add_vertex(shape, turned(glm::dvec2(radius, 0.0) + bar_radius * out, direction), turned(out, direction),
                       {static_cast<double>(i) / segments, static_cast<double>(j) / sides});
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (std::uint32_t j = 0; j < sides; ++j) {
            const std::uint32_t here = i * sides + j, up = i * sides + (j + 1u) % sides;
            const std::uint32_t next = (i + 1u) % segments * sides + j;
            const std::uint32_t next_up = (i + 1u) % segments * sides + (j + 1u) % sides;
            shape.indices.insert(shape.indices.end(), {here, next, next_up, here, next_up, up});
        }
    }
    return shape;
}

Shape make_card(const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up) {
    Shape shape;
    const glm::dvec3 r = 0.5 * right, u = 0.5 * up;
    add_quad(shape, {centre - r - u, centre + r - u, centre + r + u, centre - r + u},
             glm::normalize(glm::cross(right, up)), {glm::dvec2(0.0, 1.0), {1.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}});
    return shape;
}

Shape make_cloth(double width, double height, double fold, double waves, std::uint32_t columns, std::uint32_t rows) {
    Shape shape;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        const double down = static_cast<double>(row) / rows;
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const double across = static_cast<double>(column) / columns;
            const double angle = kTurn * waves * across;
            const double slope = fold * down * kTurn * waves / width * std::cos(angle);
            add_vertex(shape, {width * (across - 0.5), -height * down, fold * down * std::sin(angle)},
                       glm::normalize(glm::dvec3(-slope, 0.0, 1.0)), {across, down});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t top = row * (columns + 1u) + column, low = top + columns + 1u;
            shape.indices.insert(shape.indices.end(), {low, low + 1u, top + 1u, low, top + 1u, top});
        }
    }
    return shape;
}

void append(Shape& whole, const Shape& part, const glm::dmat4& from_part) {
    const std::uint32_t first = static_cast<std::uint32_t>(whole.positions.size());
    const glm::dmat3 turn(from_part);
    for (std::size_t i = 0; i < part.positions.size(); ++i) {
        add_vertex(whole, glm::dvec3(from_part * glm::dvec4(part.positions[i], 1.0)),
                   glm::normalize(turn * glm::dvec3(part.normals[i])), part.uvs[i]);
    }
    for (const std::uint32_t i : part.indices) whole.indices.push_back(first + i);
}

}  // namespace gnomon::game
