#include <cmath>
#include <random>

#include "tests/gl/frame_fixture.h"
#include "tests/system/streamed_meshes.h"

/// Meshes come and go for many frames: pictures and visibilities are then those of a scene made at once, bit for bit.
namespace gnomon {
namespace {

constexpr std::uint32_t kTexels = 32, kMatt = 0, kLate = 3;

class StreamingPictures : public FrameTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        if (HasFatalFailure() || IsSkipped()) return;
        settings.viewport_px = {192, 160};
        add_material({.name = "matt", .metallic = 0.0f});
        add_material({.name = "leaf", .base_colour_texture = 0, .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
        add_material({.name = "cut", .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask, .double_sided = true});
        library.textures.push_back(texture("dots", 3));
        place(add_mesh(game::make_card(glm::dvec3(0.0), {0.0, 0.0, 6.0}, {6.0, 0.0, 0.0})), {}, false);
        place(add_mesh(game::make_box(glm::dvec3(-0.5), glm::dvec3(0.5))), {.translation_m = {-2.5, 0.7, -2.0}});
        add_camera({.fov_y_rad = 0.9}, {0.0, 9.0, 5.0}, {0.0, -9.0, -5.0});
        const glm::dvec3 down(0.05, -1.0, 0.02);
        const auto shadow = [](ShadowFilter filter) { return LightShadow{.filter = filter, .resolution_px = 256}; };
        add_light({.kind = LightKind::spot, .intensity = 3000.0f, .outer_cone_rad = 0.7f}, {-1.5, 7.0, 0.0}, down, {.resolution_px = 256});
        add_light({.kind = LightKind::spot, .intensity = 3000.0f, .outer_cone_rad = 0.7f}, {1.5, 7.0, 0.5}, down, shadow(ShadowFilter::exact));
        add_light({.kind = LightKind::point, .intensity = 500.0f}, {0.2, 2.6, 0.1}, down, {.resolution_px = 256});
        add_light({.kind = LightKind::directional, .intensity = 200.0f}, {}, {0.4, -1.0, 0.2}, {.resolution_px = 256, .cascades = 2});
    }
    static assets::Texture texture(const char* name, std::uint32_t every) {
        assets::Texture made;
        made.name = name;
        made.width = made.height = kTexels;
        for (std::uint32_t i = 0; i < kTexels * kTexels; ++i)
            made.rgba.insert(made.rgba.end(), {90, 150, 60, static_cast<std::uint8_t>((i / 2 + i / kTexels / 2) % every == 0 ? 0 : 255)});
        return made;
    }
    /// Adds a masked material with a texture of its own.
    void add_late_leaf(std::uint32_t every) {
        const auto dots = static_cast<std::int32_t>(library.add_texture(texture("more dots", every)));
        EXPECT_EQ(library.add_material({.name = "late leaf", .base_colour_texture = dots, .metallic = 0.0f, .alpha_mode = assets::AlphaMode::mask, .double_sided = true}), kLate);
    }
    assets::Mesh any_mesh(std::mt19937_64& random) {
        const auto number = [&](std::uint32_t most) { return std::uniform_int_distribution<std::uint32_t>(0, most)(random); };
        const std::uint32_t material = number(static_cast<std::uint32_t>(library.materials.size()) - 1);
        if (number(2) > 0) return strip_mesh(1 + number(6), 0.25f + 0.05f * static_cast<float>(number(4)), material, number(1) == 0);
        const game::Shape shape = game::make_sphere(0.3 + 0.05 * number(4), 8 + 2 * number(4), 6);
        assets::Mesh mesh;
        for (std::size_t i = 0; i < shape.positions.size(); ++i) {
            mesh.vertices.push_back({shape.positions[i], shape.normals[i], shape.uvs[i]});
            mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(shape.positions[i]));
        }
        mesh.indices = shape.indices;
        mesh.submeshes = {{0, static_cast<std::uint32_t>(shape.indices.size()), material}};
        return mesh;
    }
    struct Seen {
        std::vector<std::uint8_t> picture;
        std::vector<std::vector<float>> visibilities;
        bool operator==(const Seen&) const = default;
    };
    Seen see(FrameSystem& frame) const {
        Seen seen;
        EXPECT_TRUE(frame.read_picture(seen.picture));
        for (std::uint32_t light = 0; light < frame.snapshot().lights.size(); ++light)
            EXPECT_TRUE(frame.read_visibility(light, seen.visibilities.emplace_back()));
        return seen;
    }
};

TEST_F(StreamingPictures, AreThoseOfASceneMadeAtOnce) {
    std::mt19937_64 random(7);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    struct Streaming {
        std::uint32_t mesh;
        ecs::Entity entity;
    };
    std::vector<Streaming> living;
    constexpr int kFrames = 48, kEach = 4;
    std::size_t removed = 0;
    for (int f = 0; f < kFrames; ++f) {
        if (f == 12) add_late_leaf(5);
        if (f == 30) {  // another one in the same slots
            for (const Streaming& streaming : living)
                if (library.meshes[streaming.mesh].submeshes[0].material == kLate) library.replace(streaming.mesh, strip_mesh(2, 0.4f, kMatt, false));
            library.remove_material(kLate);
            library.remove_texture(1);
            add_late_leaf(2);
        }
        for (int i = 0; i < kEach; ++i) {
            const std::uint32_t mesh = library.add(any_mesh(random));
            const glm::dvec3 at_m(number(-3, 3), number(0.2, 2.0), number(-3, 3));
            living.push_back({mesh, place(mesh, {.translation_m = at_m, .rotation = glm::angleAxis(number(0, 6), glm::dvec3(0, 1, 0))})});
        }
        while (living.size() > 18) {
            std::swap(living[static_cast<std::size_t>(number(0, static_cast<double>(living.size()) - 0.001))], living.back());
            library.remove(living.back().mesh);
            world.destroy(living.back().entity);
            living.pop_back();
            ++removed;
        }
        if (f % 8 == 5) library.replace(living.front().mesh, any_mesh(random));
        draw();
    }
    EXPECT_GT(removed, 150u);
    for (int f = 0; f < 36; ++f) draw();  // until nothing counts as moving
    const Seen lived = see(frame());

    const auto draw_at_once = [&](const assets::MeshLibrary& of) {
        auto fresh = FrameSystem::create(device(), of, frame().fit_history());
        EXPECT_TRUE(fresh);
        for (int f = 0; f < 4; ++f) fresh.value()->run(world, settings);
        return see(*fresh.value());
    };
    assets::MeshLibrary same = library;
    const Seen fresh = draw_at_once(same);
    EXPECT_EQ(lived.picture, fresh.picture);
    ASSERT_EQ(lived.visibilities.size(), 4u);
    for (std::size_t light = 0; light < 4; ++light) {
        EXPECT_EQ(lived.visibilities[light], fresh.visibilities[light]) << light;
        std::size_t dark = 0, lit = 0;
        for (const float v : lived.visibilities[light]) (v < 0.5f ? dark : lit) += v < 0.0f ? 0 : 1;
        EXPECT_GT(dark, lived.visibilities[light].size() / 50) << light;
        EXPECT_GT(lit, lived.visibilities[light].size() / 50) << light;
    }
    // Negative control: one mesh fewer is seen by every light.
    assets::MeshLibrary fewer = library;
    for (const Streaming& streaming : living) fewer.remove(streaming.mesh);
    const Seen without = draw_at_once(fewer);
    for (std::size_t light = 0; light < 4; ++light) EXPECT_NE(lived.visibilities[light], without.visibilities[light]) << light;
    EXPECT_NE(lived.picture, without.picture);
}

}  // namespace
}  // namespace gnomon
