#pragma once
#include <functional>

#include "engine/gl/gl45_objects.h"

namespace gnomon::gl {

/// Implements draw_into() of device_gl45.h.
void draw_into(const GlTarget& target, const Rect& viewport, const std::function<void()>& draw);

}  // namespace gnomon::gl
