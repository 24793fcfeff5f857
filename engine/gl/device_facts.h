#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// Description of the current OpenGL context for people. Decisions use DeviceInfo instead.
namespace gnomon::gl {

struct DeviceLimit {
    const char* name;         // OpenGL's own, without GL_
    std::int64_t value = 0;   // 0 also if the driver reports nothing
    std::int64_t needed = 0;  // minimum that Gnomon uses
    bool is_ceiling = false;  // `needed` is an upper limit
    bool serves() const { return is_ceiling ? value <= needed : value >= needed; }
};

struct DeviceExtension {
    const char* name;
    bool there = false;
    const char* use;  // use by Gnomon, or the replacement without it
};

struct DeviceFacts {
    std::string vendor, renderer, version, glsl;
    bool robust = false;  // reports a lost context
    std::vector<DeviceLimit> limits;
    std::vector<DeviceExtension> extensions;
};

/// Queries the context that is current on this thread, at least 4.5 core.
DeviceFacts read_device_facts();

}  // namespace gnomon::gl
