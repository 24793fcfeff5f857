#pragma once
#include <epoxy/gl.h>

#include <cstdint>
#include <string>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Returns a number or a text of the context; 0 or empty if it has none. Private to the executor.
std::uint32_t get_unsigned(GLenum name);
std::string get_string(GLenum name);
/// Returns what the context offers.
DeviceInfo read_info();

}  // namespace gnomon::gl
