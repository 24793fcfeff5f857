#pragma once
#include <cstdint>
#include <vector>

#include "tests/system/random_choice.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// A world in which anything may change from one frame to the next, the same way for the same seed. Lights, casters and
/// up to three cameras appear, move, take other settings, turn away, and vanish. Half of the frames change nothing, so
/// that there is something to save.
class ChangingWorld : RandomChoice {
public:
    /// Makes a world with a plane, a camera, some lights and casters. `filters`: what lights choose from; each one
    /// costs programs.
    ChangingWorld(std::uint64_t seed, std::vector<ShadowFilter> filters);

    ecs::Registry& registry() { return world_.registry; }
    /// Changes something, or nothing. Call it before each frame.
    void change();

    static constexpr std::size_t kMostLights = 5, kMostCasters = 12, kMostCameras = 3;

private:
    std::uint32_t below(std::size_t count);
    template <class T>
    const T& any_of(const std::vector<T>& from) {
        return from[below(from.size())];
    }
    void put_any_shadow(ecs::Entity light);
    void add_light();
    void add_caster();
    void add_camera();
    void turn_camera(ecs::Entity camera);
    void change_light(ecs::Entity light);
    void change_caster(ecs::Entity caster);
    void remove_one(std::vector<ecs::Entity>& from);

    std::vector<ShadowFilter> filters_;
    TestWorld world_;
    std::vector<ecs::Entity> lights_, casters_, cameras_;
};

}  // namespace gnomon
