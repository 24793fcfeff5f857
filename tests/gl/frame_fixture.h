#pragma once
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>

#include "gnomon/components.h"
#include "sample_game/support/built_in_scenes/primitives.h"
#include "systems/frame_system.h"
#include "tests/gl/gl_test_context.h"
#include "tests/system/edit_light.h"

namespace gnomon {

inline glm::dquat looking_along(const glm::dvec3& direction) {
    const bool upright = std::abs(glm::normalize(direction).y) > 0.99;
    return glm::quatLookAt(glm::normalize(direction), upright ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0));
}

/// A world of few entities, drawn by the whole pipeline. Meshes and materials come before the first draw().
class FrameTest : public GlTest {
protected:
    void TearDown() override {
        frame_.reset();
        GlTest::TearDown();
    }

    std::uint32_t add_material(const assets::Material& material) {
        library.materials.push_back(material);
        return static_cast<std::uint32_t>(library.materials.size() - 1);
    }

    std::uint32_t add_mesh(const game::Shape& shape, std::optional<std::uint32_t> material = {}) {
        if (library.materials.empty()) add_material({.name = "matt", .metallic = 0.0f});
        assets::Mesh mesh;
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
            mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
            mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(shape.positions[i]));
        }
        mesh.indices = shape.indices;
        mesh.submeshes = {{0, static_cast<std::uint32_t>(shape.indices.size()), material.value_or(0)}};
        library.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(library.meshes.size() - 1);
    }

    ecs::Entity place(std::uint32_t mesh, const Transform& transform = {}, bool casts = true) {
        const ecs::Entity entity = world.create();
        world.emplace<Transform>(entity, transform);
        world.emplace<MeshRef>(entity, {.mesh = mesh});
        if (casts) world.emplace<ShadowCaster>(entity);
        return entity;
    }

    ecs::Entity add_light(const Light& light, const glm::dvec3& position, const glm::dvec3& direction,
                          const LightShadow& shadow = {.resolution_px = 512}, const ShadowTuning& tuning = {}) {
        const ecs::Entity entity = world.create();
        world.emplace<Transform>(entity, {.translation_m = position, .rotation = looking_along(direction)});
        world.emplace<Light>(entity, light);
        world.emplace<LightShadow>(entity, shadow);
        if (!(tuning == ShadowTuning{})) world.emplace<ShadowTuning>(entity, tuning);
        return entity;
    }

    ecs::Entity add_camera(const Camera& camera, const glm::dvec3& position, const glm::dvec3& direction) {
        const ecs::Entity entity = world.create();
        world.emplace<Transform>(entity, {.translation_m = position, .rotation = looking_along(direction)});
        world.emplace<Camera>(entity, camera);
        return entity;
    }

    /// Drops frame, world and library, so that another world can be filled.
    void start_anew() {
        frame_.reset();
        world = {};
        library = {};
    }

    void draw() {
        if (!frame_) {
            auto made = FrameSystem::create(device(), library);
            ASSERT_TRUE(made) << to_line(made.error());
            frame_ = std::move(made).value();
        }
        frame_->run(world, settings);
        EXPECT_STREQ(gl::to_text(frame_->report().failure), "none");
    }

    FrameSystem& frame() { return *frame_; }
    std::vector<float> visibility(std::uint32_t light = 0) {
        std::vector<float> values;
        EXPECT_TRUE(frame_->read_visibility(light, values));
        return values;
    }
    std::vector<std::uint8_t> picture() {
        std::vector<std::uint8_t> rgba;
        EXPECT_TRUE(frame_->read_picture(rgba));
        return rgba;
    }

    ecs::Registry world;
    assets::MeshLibrary library;
    /// Shadows are looked at one by one, however dim their lights.
    FrameSettings settings{.viewport_px = {320, 256}, .exposure_ev = 10.0f, .leave_out_dim_lights = false};

private:
    std::unique_ptr<FrameSystem> frame_;
};

}  // namespace gnomon
