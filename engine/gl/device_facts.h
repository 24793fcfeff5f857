#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// What the current OpenGL context says of itself, for people: nothing is decided by it (DeviceInfo is for that).
namespace gnomon::gl {

struct DeviceLimit {
    const char* name;         // OpenGL's own, without GL_
    std::int64_t value = 0;   // 0 also where the driver does not say
    std::int64_t needed = 0;  // what Gnomon uses at least
    bool is_ceiling = false;  // `needed` is the most that serves, not the least
    bool serves() const { return is_ceiling ? value <= needed : value >= needed; }
};

struct DeviceExtension {
    const char* name;
    bool there = false;
    const char* use;  // what Gnomon does with it, or without
};

struct DeviceFacts {
    std::string vendor, renderer, version, glsl;
    bool robust = false;  // says when the context is lost
    std::vector<DeviceLimit> limits;
    std::vector<DeviceExtension> extensions;
};

/// Asks the context that is current on this thread; it must be 4.5 core.
DeviceFacts read_device_facts();

}  // namespace gnomon::gl
