#pragma once
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// State of the current context by name, with an index where it has one.
using GlStateRecord = std::map<std::string, std::vector<double>>;

/// Records all state of OpenGL 4.5 core that can be queried, except the contents of objects.
/// - every mode and capability; every viewport, draw buffer, texture unit, image unit and indexed buffer
/// - the vertex array and framebuffers that are bound, subroutines of the program or pipeline
/// - queries and feedback that run, debug output
/// Changes nothing, and takes no error.
GlStateRecord record_gl_state();

/// Returns the names of values that differ, each with both values.
std::vector<std::string> differences(const GlStateRecord& before, const GlStateRecord& after);

}  // namespace gnomon
