#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "systems/frame_system.h"
#include "tests/system/random_choice.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// A world that never stays the same: lights and casters come, move, change and go at random, the same way for the
/// same seed. Ground and camera stay.
class SoakWorld : RandomChoice {
public:
    explicit SoakWorld(std::uint64_t seed);

    ecs::Registry& registry() { return world_.registry; }
    /// Changes something or other; to be called before each frame.
    void churn();
    /// Runs one frame for each kind of light with each filter, so that whatever is made once has been made.
    void use_everything(const std::function<void()>& run_frame);
    /// Removes all lights and casters, and runs frames until nothing of them need be kept.
    void clear(const std::function<void()>& run_frame);

    static constexpr std::size_t kMostLights = 6, kMostCasters = 24;

private:
    void leave_to_rays(const std::function<void()>& run_frame);
    void use_every_light(const std::function<void()>& run_frame);
    ecs::Entity& any_of(std::vector<ecs::Entity>& from);
    void add_light(LightKind kind, ShadowFilter filter);
    void add_caster();
    void churn_lights();
    void change_light(ecs::Entity light);
    void remove_one(std::vector<ecs::Entity>& from);

    TestWorld world_;
    ecs::Entity camera_;
    std::vector<ecs::Entity> lights_, casters_;
};

/// Returns the bytes that this process holds: its writable private memory, less what the allocator has free in it.
/// Resident memory would also depend on where the allocator happens to place things: which of its pages are touched.
std::size_t held_bytes();

}  // namespace gnomon
