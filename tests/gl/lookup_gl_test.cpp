#include "tests/gl/lookup_fixture.h"

/// All lights of a view in one draw, by one program (systems/lookup), against the lighting's own pass per light.
namespace gnomon {
namespace {

class AllLights : public LookupTest {
protected:
    void SetUp() override {
        FrameTest::SetUp();
        const std::uint32_t plane = add_mesh(game::make_card({0, 0, 0}, {0, 0, 6}, {6, 0, 0}));
        const std::uint32_t box = add_mesh(game::make_box({-0.5, 0.0, -0.5}, {0.5, 1.5, 0.5}));
        place(plane, {}, false);
        for (const double x : {-1.5, 1.5}) boxes.push_back(place(box, {.translation_m = {x, 0.3, 0.4 * x}}));
        add_camera({}, {0.0, 5.0, 7.0}, {0.0, -5.0, -7.0});
        settings.viewport_px = {160, 120};
    }
    /// A light of a kind, at a place of its own.
    ecs::Entity add(LightKind kind, const LightShadow& wish, std::size_t i, const ShadowTuning& tuning = {},
                    float cone_rad = 0.6f) {
        const Light light{.kind = kind,
                          .intensity = 100.0f,
                          .outer_cone_rad = cone_rad,
                          .source_radius_m = 0.1f,
                          .sun_radius_rad = 0.03f};
        const double angle = 0.7 * static_cast<double>(i);
        const glm::dvec3 at(2.0 * std::cos(angle), 3.5, 2.0 * std::sin(angle));
        return add_light(light, at, -at, wish, tuning);
    }
    /// Eight: suns, spots narrow and wide, and points, of many sizes.
    void add_eight(ShadowFilter filter = ShadowFilter::automatic) {
        using enum LightKind;
        std::size_t i = 0;
        for (const LightKind kind : {directional, spot, point, spot, point, spot, directional, point}) {
            const float cone_rad = i == 5 ? 1.4f : 0.6f;  // a wide one has faces
            lights.push_back(add(kind, {.filter = filter, .resolution_px = static_cast<std::uint32_t>(i % 3 == 0 ? 700 : i % 3 == 1 ? 256 : 400)}, i, {}, cone_rad));
            ++i;
        }
    }
    /// Expects every light to be looked up as by its own pass. Returns the largest difference.
    double expect_alike(gl::ProgramHandle program, std::size_t most_pixels = 0) {
        const auto found = looked_up(program);
        double largest = 0.0;
        for (std::uint32_t i = 0; i < found.size(); ++i) {
            const Difference d = difference(found[i], recorded(i));
            SCOPED_TRACE(std::to_string(i) + ": " + std::string(inputs().lights[i].row.kind_file) + " " + std::string(inputs().lights[i].row.filter_file));
            EXPECT_EQ(table->outcomes()[i].status, lookup::LookupStatus::own_filter) << lookup::to_text(table->outcomes()[i].status);
            EXPECT_LE(d.pixels, most_pixels) << d.largest;
            EXPECT_TRUE(d.dark > 100 && d.lit > 100) << d.dark << " dark, " << d.lit << " lit";
            largest = std::max(largest, d.largest);
        }
        return largest;
    }

    std::vector<ecs::Entity> boxes, lights;
};

TEST_F(AllLights, OfEveryKindInOneDrawAreSeenAsByTheirOwnPass) {
    add_eight();
    start();
    run();
    const gl::ProgramHandle program = surface_program();
    RecordProperty("largest_difference", std::to_string(expect_alike(program)));
}

}  // namespace
}  // namespace gnomon
