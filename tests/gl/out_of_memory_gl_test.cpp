#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "engine/gl/device_gl45.h"
#include "engine/platform/context.h"
#include "gnomon/components.h"
#include "systems/frame_system.h"
#include "systems/shadow/maps/map_cache.h"
#include "tests/system/test_world.h"

// Memory that really runs out: a child process under an address-space limit requests maps that do not fit.
namespace gnomon {
namespace {

constexpr std::uint32_t kSmall_px = 64, kHuge_px = 8192;
constexpr rlim_t kHeadroom_bytes = rlim_t{192} << 20;

/// Limits the address space to what this process uses now, plus kHeadroom_bytes.
bool limit_memory() {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t now = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0) return false;
    limit.rlim_cur = now + kHeadroom_bytes;
    std::cerr << "address space limited to " << limit.rlim_cur / (1 << 20) << " MiB\n";
    return setrlimit(RLIMIT_AS, &limit) == 0;
}
bool lift_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0) return false;
    limit.rlim_cur = limit.rlim_max;
    return setrlimit(RLIMIT_AS, &limit) == 0;
}

struct Child {
    TestWorld world;
    std::vector<ecs::Entity> lights;
    std::unique_ptr<FrameSystem> frame;

    bool deliver() {
        std::vector<std::uint8_t> picture;
        frame->run(world.registry, {.viewport_px = {64, 64}, .exposure_ev = 10.0f});
        return frame->read_picture(picture) && frame->report().lights.size() == lights.size();
    }
    void ask_for(std::uint32_t resolution_px) {
        for (const ecs::Entity light : lights)
            world.registry.patch<LightShadow>(light, [&](LightShadow& s) { s.resolution_px = resolution_px; });
    }
    void cast_shadows(bool wanted) {
        for (const ecs::Entity light : lights)
            world.registry.patch<LightShadow>(light, [&](LightShadow& s) { s.enabled = wanted; });
    }
    std::size_t count(LightState state) const {
        std::size_t n = 0;
        for (const LightReport& light : frame->report().lights) n += light.state == state;
        return n;
    }
};

[[noreturn]] void quit(int code, const char* why) {
    std::cerr << why << '\n';
    std::_Exit(code);  // the exit handlers belong to the parent
}

/// Exits with code 0 and "delivered" if every frame was and every light reported what became of its shadow.
[[noreturn]] void run_out_of_memory() {
    constexpr int kStarved = 45, kWarmUp = 3;
    // Maps must lie in this process's memory, which is what the limit is about.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    auto context = platform::make_headless_context(false);
    if (!context) quit(2, "no context");
    auto device = gl::make_gl45_device({});
    if (!device || !device.value()->info().is_software) quit(2, "no software device");
    const assets::MeshLibrary library = test_library();
    auto made = FrameSystem::create(*device.value(), library);
    if (!made) quit(2, "no frame");
    Child child;
    child.frame = std::move(made).value();
    child.world.add_stage();
    for (const auto kind : {LightKind::directional, LightKind::spot, LightKind::point})
        child.lights.push_back(child.world.add_light(kind, kLightPlace_m, "light"));
    child.ask_for(kSmall_px);
    // First what lights without a map use: the driver's own compiler ends the process where it finds no memory.
    for (const bool shadows : {false, true}) {
        child.cast_shadows(shadows);
        for (int i = 0; i < kWarmUp; ++i)
            if (!child.deliver()) quit(3, "no frame before the limit");
    }
    if (child.count(LightState::degraded) + child.count(LightState::skipped) != 0) quit(4, "degraded before the limit");

    if (!limit_memory()) quit(2, "no limit");
    child.ask_for(kHuge_px);
    for (int i = 0; i < kStarved; ++i)
        if (!child.deliver()) quit(5, "a starved frame was not delivered");
    for (const LightReport& light : child.frame->report().lights)
        std::cerr << light.name << ": " << to_text(light.state) << ", " << reason_code(light.reason) << ", "
                  << light.counts.bytes / (1 << 20) << " MiB\n";
    if (child.count(LightState::degraded) + child.count(LightState::skipped) != child.lights.size())
        quit(6, "a light lost its map in silence");
    for (const LightReport& light : child.frame->report().lights)
        if (light.state == LightState::skipped && light.reason != Reason::map_allocation_failed)
            quit(7, "a wrong reason");

    if (!lift_limit()) quit(2, "no end to the limit");
    child.ask_for(kSmall_px * 2);
    for (std::uint64_t i = 0; i <= shadow::MapCache::kRetryFrames; ++i)
        if (!child.deliver()) quit(8, "a frame after the limit was not delivered");
    if (child.count(LightState::degraded) + child.count(LightState::skipped) != 0) quit(9, "shadows did not come back");
    quit(0, "every frame was delivered");
}

TEST(OutOfMemoryDeathTest, EveryFrameIsDeliveredAndEachLightSaysWhatItLost) {
    EXPECT_EXIT(run_out_of_memory(), ::testing::ExitedWithCode(0), "every frame was delivered");
}

}  // namespace
}  // namespace gnomon
