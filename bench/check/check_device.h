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

/// Derives what works on a device from the facts that its context reports.
DeviceCheck check_device(gl::DeviceFacts facts, const gl::DeviceInfo& info);

}  // namespace gnomon::bench
