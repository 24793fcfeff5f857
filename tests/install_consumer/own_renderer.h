#pragma once
#include <epoxy/gl.h>

#include <string>
#include <vector>

#include "gnomon/result.h"
#include "ground_and_box.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/shadow_frame.h"

/// What the stranger's two renderers share.

/// The stage, with a light of each kind. Lamps stand far away on the sun's line, so that all shadows lie where the
/// sun's does.
gnomon::SceneSnapshot stage_with(const std::vector<gnomon::LightKind>& kinds, const gnomon::LightShadow& shadow,
                                 const gnomon::assets::MeshLibrary& library);

/// Returns `main_text` with all it includes, for one light. row.glsl and its defines select the kind and the filter.
gnomon::Result<std::string> fragment_for(const gnomon::shadow::ShaderKey& row, const char* main_text);

/// 0 if it does not compile or link; stderr says why.
GLuint make_program(const char* vertex, const char* fragment);
GLuint make_buffer(std::size_t bytes);
