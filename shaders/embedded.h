#pragma once
#include <span>

#include "engine/gl/shader_source.h"

namespace gnomon {

/// Returns every file under shaders/ that the build lists, for expand_shader().
std::span<const gl::ShaderFile> shader_files();

}  // namespace gnomon
