#pragma once
#include <string>
#include <vector>

#include "engine/gl/device.h"
#include "engine/gl/device_facts.h"

namespace gnomon::bench {

struct DeviceCheck {
    gl::DeviceFacts facts;
    gl::DeviceInfo info;                // what Gnomon works by
    std::vector<std::string> follow;    // what Gnomon makes of it, a sentence each
    std::vector<std::string> short_of;  // limits that do not serve; empty: all do
};

/// What follows from what a context says of itself.
DeviceCheck check_device(gl::DeviceFacts facts, const gl::DeviceInfo& info);

}  // namespace gnomon::bench
