#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

/// Parsers of arguments about pictures and scenes.
namespace gnomon::bench {

/// Reads "WIDTHxHEIGHT", each 1 to 16384, which OpenGL 4.5 guarantees for pictures.
std::optional<glm::uvec2> parse_size(const std::string& text);
/// Reads "X,Y,Z" in metres. An empty text stands for 0.
std::optional<glm::dvec3> parse_offset(const std::string& text);

}  // namespace gnomon::bench
