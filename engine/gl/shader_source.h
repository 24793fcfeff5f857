#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/result.h"

namespace gnomon::gl {

/// GLSL file, embedded at build time. `path` is relative to shaders/, e.g. "shadow/filters/pcf/hard.glsl".
struct ShaderFile {
    std::string_view path;
    std::string_view text;
};

/// Expands `path`. Prepends "#version 450 core", then one #define per entry of `defines` ("NAME value"). Replaces each
/// line  #include "x.glsl"  by that file, once per expansion, even inside an inactive #if. A define  NAME "path"  makes
/// #include NAME  include that file. It is not written as a #define: GLSL has no quotes. Adds #line directives; their
/// second number is the file's index in `files`. Errors: missing file, include cycle (rules "shader.missing",
/// "shader.cycle").
Result<std::string> expand_shader(std::span<const ShaderFile> files, std::string_view path,
                                  std::span<const std::string> defines);

/// Returns a compiler's log with paths in the place of the numbers that expand_shader() wrote: 3:7(1) and 3(7) begin
/// with the path of files[3]. Numbers of no file stay.
std::string with_paths(const std::string& log, std::span<const ShaderFile> files);

}  // namespace gnomon::gl
