#pragma once
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// State of the current context by name, with an index where it has one.
using GlStateRecord = std::map<std::string, std::vector<double>>;

/// Records all state of OpenGL 4.5 core that can be queried, except the contents of objects: every binding of every
/// unit, viewport and draw buffer, all modes, the vertex array and framebuffers that are bound, queries and feedback
/// that run, subroutines, and debug output. Changes nothing, and takes no error.
GlStateRecord record_gl_state();

/// Returns the names whose values differ, each with both values.
std::vector<std::string> differences(const GlStateRecord& before, const GlStateRecord& after);

}  // namespace gnomon
