#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

/// What users type of pictures and scenes.
namespace gnomon::bench {

/// "WIDTHxHEIGHT", each 1 to 16384, which OpenGL 4.5 guarantees for pictures.
std::optional<glm::uvec2> parse_size(const std::string& text);
/// "X,Y,Z" in metres; 0 of nothing.
std::optional<glm::dvec3> parse_offset(const std::string& text);

}  // namespace gnomon::bench
