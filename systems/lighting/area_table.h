#pragma once
#include <cstddef>
#include <span>

#include "engine/gl/device.h"
#include "gnomon/result.h"

/// Lobes by which surfaces mirror area lights (shaders/lighting/lights/area_light.glsl).
namespace gnomon::lighting {

/// One lobe: FittedLobe of bench/area_table/lobe_fit.h.
struct AreaLobe {
    float lean, along, across, skew, size;
};

/// Lobes of one roughness and angle: of all that is reflected, and of what Fresnel's term adds.
struct AreaLobes {
    AreaLobe reflected, grazing;
};

/// Returns all lobes, rows of rising angle, in each the roughnesses from 0 to 1. gnomon_area_table writes them.
std::span<const AreaLobes> area_lobes();

/// Buffer with the lobes. Owns it. A scene without an area light has none.
class AreaTable {
public:
    explicit AreaTable(gl::Device& device) : device_(device) {}
    ~AreaTable() { release(); }
    AreaTable(const AreaTable&) = delete;
    AreaTable& operator=(const AreaTable&) = delete;

    /// Creates or frees it. Returns false if it is wanted and there is no room.
    bool provide(bool wanted);
    gl::BufferHandle buffer() const { return buffer_; }  // {0}: not wanted

private:
    void release();

    gl::Device& device_;
    gl::BufferHandle buffer_{};
};

}  // namespace gnomon::lighting
