#pragma once
#include <span>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon {

/// Creates a buffer with these values; of one empty element if there are none.
template <class T>
gl::Created<gl::BufferHandle> filled_buffer(gl::Device& device, const char* label, const std::vector<T>& values,
                                            gl::BufferUse use = gl::BufferUse::fixed, bool texels = false) {
    static const T kNothing{};  // a buffer must have a size; nothing of an empty library is drawn from it
    const auto bytes = values.empty() ? std::as_bytes(std::span(&kNothing, 1)) : std::as_bytes(std::span(values));
    return device.create_buffer({label, bytes.size(), use, texels}, bytes);
}

}  // namespace gnomon
