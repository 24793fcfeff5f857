#pragma once
#include <cstdint>

namespace gnomon::gl {

/// Typed id of a device object. 0 is "none". A device never reuses an id.
template <class Tag>
struct Handle {
    std::uint32_t id = 0;
    explicit operator bool() const { return id != 0; }
    bool operator==(const Handle&) const = default;
};

using TextureHandle = Handle<struct TextureTag>;
using SamplerHandle = Handle<struct SamplerTag>;
using BufferHandle = Handle<struct BufferTag>;
using ProgramHandle = Handle<struct ProgramTag>;
using TargetHandle = Handle<struct TargetTag>;  // framebuffer; {0} is the window's

}  // namespace gnomon::gl
