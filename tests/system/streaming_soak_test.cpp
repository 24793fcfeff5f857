#include <gmock/gmock.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>

#include "gnomon/components.h"
#include "systems/shadow/culling/static_dynamic_casters.h"
#include "tests/long_run.h"
#include "tests/soak/soak_world.h"
#include "tests/system/frame_fixture.h"
#include "tests/system/streamed_meshes.h"
#include "tests/unit/math/random_seed.h"

/// A thousand meshes come and a thousand go within three hundred frames.
namespace gnomon {
namespace {

using ::testing::IsEmpty;

constexpr int kFrames = 300;
constexpr std::size_t kMeshes = 1000, kMostAtOnce = 90;
constexpr int kRest = 100;                  // longer than anything counts: maps, what was seen, unused halves of buffers
constexpr std::size_t kMostHostGrowth_bytes = 1u << 20;
/// Places along x. A map of a face of a lamp that reaches 3 m contains casters up to 4 m along its axis: 4 √3 m away.
constexpr double kQuiet_m = -6.0, kBusy_m = 5.0;

/// Buffers that hold meshes, and nothing else.
constexpr const char* kMeshBuffers[] = {"scene vertices", "scene indices", "triangle normals", "vertex colours", "caster triangles",
                                        "caster masks", "materials", "ray trees of meshes", "ray triangles", "ray masks"};

/// A device with a frame, and the world that it shows: some meshes that stay, lamps over these, and lamps elsewhere.
struct Streamed {
    Streamed() : made(FrameSystem::create(device, library)) {}
    ~Streamed() {
        made.value().reset();
        device.check_leaks();
        check();
    }
    void fill() {
        world.add_mesh(kPlane, {}, false);
        mover = world.add_mesh(kBox, {kBusy_m, 1, 3}, true);
        world.add_camera({0, 18, 8}, {0, 0, 0});
        std::mt19937_64 random(5);
        for (int i = 0; i < 12; ++i) residents.push_back(random_mesh(random));
        residents.push_back(strip_mesh(4, 0.3f, 1, true));
        residents.push_back(strip_mesh(4, 0.3f, 1, false));
        for (const ShadowFilter filter : {ShadowFilter::triangles, ShadowFilter::exact, ShadowFilter::hard})
            for (const bool busy : {false, true})
                for (const LightKind kind : {LightKind::spot, LightKind::point}) add_lamp(busy, kind, filter);
    }
    void add_lamp(bool busy, LightKind kind, ShadowFilter filter) {
        const std::string name = (busy ? "busy " : "quiet ") + std::to_string(static_cast<int>(kind)) + " " + std::to_string(static_cast<int>(filter));
        const ecs::Entity lamp = world.add_light(kind, {busy ? kBusy_m : kQuiet_m, 2, 0}, name);
        world.registry.patch<Transform>(lamp, [](Transform& t) { t.rotation = glm::dquat(glm::dvec3(-1.5707963, 0, 0)); });
        world.registry.patch<Light>(lamp, [](Light& l) { l.range_m = 3.0f, l.outer_cone_rad = 0.6f, l.inner_cone_rad = 0.5f; });
        world.registry.patch<LightShadow>(lamp, [&](LightShadow& s) { s.filter = filter, s.resolution_px = 128; });
    }
    void place_residents(const std::vector<std::uint32_t>& meshes) {
        for (std::size_t i = 0; i < meshes.size(); ++i)
            world.add_mesh(meshes[i], {kQuiet_m + 0.2 * (static_cast<double>(i) - 6.0), 1, 0.1 * static_cast<double>(i % 3)}, true);
    }
    void step() {
        made.value()->run(world.registry, {.viewport_px = {64, 64}, .exposure_ev = {}, .leave_out_dim_lights = false});
        check();
        device.forget();
    }
    void check() {
        for (const gl::Finding& f : device.findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
    }
    /// Frames in which a box moves, so that rays are kept up to date, and as many without.
    void rest() {
        for (int i = 0; i < kRest; ++i) {
            world.move(mover, {kBusy_m, 1, 3 + 0.001 * (i % 2)});
            step();
        }
        world.move(mover, {kBusy_m, 1, 3});
        for (int i = 0; i < kRest; ++i) step();
    }
    std::uint32_t views_drawn(const std::string& begins) const {
        std::uint32_t views = 0;
        for (const LightReport& light : made.value()->report().lights)
            if (light.name.starts_with(begins)) views += light.counts.views_drawn;
        return views;
    }
    std::map<std::string, std::uint64_t> mesh_bytes() const {
        std::map<std::string, std::uint64_t> bytes;
        for (std::uint32_t id = 1; id < 1u << 16; ++id) {
            const gl::BufferDesc* desc = device.buffer({id});
            if (desc && std::find(std::begin(kMeshBuffers), std::end(kMeshBuffers), desc->label) != std::end(kMeshBuffers))
                bytes[desc->label] += desc->size;
        }
        return bytes;
    }

    gl::RecordingDevice device;
    assets::MeshLibrary library = test_library();
    TestWorld world;
    std::vector<assets::Mesh> residents;
    ecs::Entity mover;
    Result<std::unique_ptr<FrameSystem>> made;
};

TEST(StreamingSoak, AThousandMeshesComeAndGoAndLeaveNothingBehind) {
    Streamed lived;
    lived.fill();
    std::vector<std::uint32_t> meshes;
    for (const assets::Mesh& mesh : lived.residents) meshes.push_back(lived.library.add(mesh));
    lived.place_residents(meshes);
    lived.rest();
    std::mt19937_64 random(print_seed());
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };

    struct Streaming {
        std::uint32_t mesh;
        ecs::Entity entity;
    };
    std::vector<Streaming> living;
    std::size_t added = 0, removed = 0, most = 0, dropped = 0, held_before = 0;
    std::uint64_t quiet_views = 0, busy_views = 0, most_bytes = 0;
    const auto frames = [&](int count, std::size_t meshes_each) {
        for (int f = 0; f < count; ++f) {
            const std::size_t due = (static_cast<std::size_t>(f) + 1) * meshes_each / static_cast<std::size_t>(count - 20);
            for (; added < std::min(due, meshes_each); ++added) {
                const std::uint32_t mesh = lived.library.add(random_mesh(random));
                living.push_back({mesh, lived.world.add_mesh(mesh, {kBusy_m + number(-1.5, 1.5), number(0.3, 2.0), number(-1.5, 1.5)}, true)});
            }
            most = std::max(most, living.size());
            const std::size_t may_stay = f < count - 20 ? kMostAtOnce : static_cast<std::size_t>(4 * (count - 1 - f));
            for (std::size_t due_off = living.size() > may_stay ? living.size() - may_stay : living.size() / 20; due_off > 0 && !living.empty(); --due_off, ++removed) {
                std::swap(living[static_cast<std::size_t>(number(0, static_cast<double>(living.size()) - 0.001))], living.back());
                lived.library.remove(living.back().mesh);
                lived.world.registry.destroy(living.back().entity);
                living.pop_back();
            }
            lived.step();
            quiet_views += lived.views_drawn("quiet");
            busy_views += lived.views_drawn("busy");
            dropped += lived.made.value()->report().dropped.size();
            most_bytes = std::max(most_bytes, lived.device.live_bytes());
        }
    };
    // Once to warm up, so that the allocator, registry and scratch lists have what they need at most.
    frames(kFrames, kMeshes);
    lived.rest();
    held_before = held_bytes();
    added = removed = most = 0;
    quiet_views = busy_views = 0;
    frames(kFrames, kMeshes);

    EXPECT_EQ(added, kMeshes);
    EXPECT_EQ(removed, kMeshes);
    EXPECT_THAT(living, IsEmpty());
    EXPECT_GT(most, kMostAtOnce / 2);
    EXPECT_EQ(dropped, 0u);
    EXPECT_EQ(quiet_views, 0u) << "views that show none of them";
    EXPECT_GT(busy_views, static_cast<std::uint64_t>(kFrames)) << "the soak did soak";
    EXPECT_LE(lived.library.meshes.size(), 6 + lived.residents.size() + kMostAtOnce + 10) << "slots are taken again";
    lived.rest();
    const std::size_t held_after = held_bytes();
    if (!kSanitized) {  // they keep freed memory
        EXPECT_LE(held_after, held_before + kMostHostGrowth_bytes);
    }

    Streamed fresh;
    fresh.fill();
    fresh.library.meshes.resize(6);
    std::vector<std::uint32_t> again;
    for (const assets::Mesh& mesh : fresh.residents) again.push_back(fresh.library.add(mesh));
    fresh.place_residents(again);
    fresh.rest();
    const std::vector<std::string> left = lived.device.live_labels(), right = fresh.device.live_labels();
    std::vector<std::string> more, less;
    std::set_difference(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(more));
    std::set_difference(right.begin(), right.end(), left.begin(), left.end(), std::back_inserter(less));
    std::erase_if(more, [](const std::string& label) { return label.starts_with("light "); });  // programs stay
    EXPECT_THAT(more, IsEmpty());
    EXPECT_THAT(less, IsEmpty());
    EXPECT_EQ(lived.mesh_bytes(), fresh.mesh_bytes());
    EXPECT_EQ(lived.mesh_bytes().size(), std::size(kMeshBuffers)) << "all were in use";
    std::cout << "at most " << most << " at once; device bytes: at most " << most_bytes << ", at the end " << lived.device.live_bytes()
              << ", made at once " << fresh.device.live_bytes() << "; host grew by "
              << static_cast<std::int64_t>(held_after) - static_cast<std::int64_t>(held_before) << "; views drawn " << busy_views << "\n";
}

TEST(StreamingSoak, WhatIsNotRemovedWouldBeSeen) {
    Streamed lived;
    lived.fill();
    lived.library.add(strip_mesh(1, 0.3f, 1, true));
    lived.step();
    const auto before = lived.mesh_bytes();
    for (int i = 0; i < 100; ++i) lived.library.add(strip_mesh(4, 0.3f, 1, true));
    lived.step();
    EXPECT_NE(lived.mesh_bytes(), before);
}

}  // namespace
}  // namespace gnomon
