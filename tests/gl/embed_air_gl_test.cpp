#include <glm/vec4.hpp>
#include <iostream>
#include <random>

#include "tests/gl/full_screen_pass.h"
#include "tests/unit/math/random_seed.h"

// Places in the air, as an engine's fog shader looks them up in the maps of declared boxes, against rays.
namespace gnomon {
namespace {

constexpr int kSide_px = 96;  // a place per pixel

/// A pass that writes the visibility of one light at each of a texture's places.
class AirPass {
public:
    explicit AirPass(const std::string& lookups)
        : pass_({kSide_px, kSide_px}, lookups + R"(
layout(binding = 0) uniform sampler2D places;   // from the camera
uniform int light;
layout(location = 0) out float visible;
void main() { visible = gnomon_visibility(light, texelFetch(places, ivec2(gl_FragCoord.xy), 0).xyz); })") {
        glCreateTextures(GL_TEXTURE_2D, 1, &places_);
        glTextureStorage2D(places_, 1, GL_RGBA32F, kSide_px, kSide_px);
    }
    ~AirPass() { glDeleteTextures(1, &places_); }
    std::vector<float> looked_up(const std::vector<glm::vec4>& places_ca, int light) const {
        glTextureSubImage2D(places_, 0, 0, 0, kSide_px, kSide_px, GL_RGBA, GL_FLOAT, places_ca.data());
        glBindTextureUnit(0, places_);
        glUniform1i(pass_.use("light"), light);
        return pass_.drawn();
    }

private:
    FullScreenPass pass_;
    GLuint places_ = 0;
};

class EmbedAir : public EmbedTest {
protected:
    ShadowsOptions options() override {
        ShadowsOptions wanted = EmbedTest::options();
        wanted.lookup = lookup_of_triangles();
        return wanted;
    }
    void SetUp() override {
        EmbedTest::SetUp();
        make_engine(Depths::usual_float);
        look_from({0.5, 2.5, 4.0});
        view.wants_mask = false;
        view.clip_from_view = engine->projection();
        view.size_px = {kWidth_px, kHeight_px};
    }
    static AirDesc box_of(const Bounds& bounds) {
        const glm::dmat4 at = glm::translate(glm::dmat4(1.0), 0.5 * (bounds.min_m + bounds.max_m));
        return {.world_from_box = glm::scale(at, bounds.max_m - bounds.min_m)};
    }
    /// Returns random places in a box that the view sees.
    std::vector<glm::dvec3> places_in(const Bounds& box) {
        const glm::dmat4 clip_from_world = view.clip_from_view * glm::inverse(view.world_from_view);
        std::vector<glm::dvec3> places;
        std::uniform_real_distribution<double> share(0.0, 1.0);
        while (places.size() < static_cast<std::size_t>(kSide_px * kSide_px)) {
            const glm::dvec3 at =
                glm::mix(box.min_m, box.max_m, glm::dvec3(share(random_), share(random_), share(random_)));
            const glm::dvec4 clip = clip_from_world * glm::dvec4(at, 1.0);
            if (clip.w > kNear_m && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w) places.push_back(at);
        }
        return places;
    }
    struct Result {
        std::size_t dark = 0, wrong = 0;  // truly dark; more than a half off
        std::vector<float> looked_up;
        double wrong_share() const { return static_cast<double>(wrong) / static_cast<double>(looked_up.size()); }
    };
    /// Renders, looks the places up, and traces rays.
    Result judged(LightId light, const std::vector<glm::dvec3>& places) {
        EXPECT_EQ(shadows->render(view).failure, "");
        EXPECT_TRUE(shadows->bind_lookup());
        std::vector<glm::vec4> places_ca;
        for (const glm::dvec3& at : places)
            places_ca.emplace_back(glm::vec3(at - glm::dvec3(view.world_from_view[3])), 1.0f);
        if (!pass_) pass_ = std::make_unique<AirPass>(shadows->lookup_glsl().value());
        Result result{.looked_up = pass_->looked_up(places_ca, shadows->lookup_index(light))};
        for (std::size_t i = 0; i < places.size(); ++i) {
            const float truth = shadows->visibility(light, places[i]);
            result.dark += truth < 0.5f;
            result.wrong += std::abs(truth - result.looked_up[i]) > 0.5f;
        }
        return result;
    }
    void TearDown() override {
        pass_.reset();
        EmbedTest::TearDown();
    }

    std::mt19937_64 random_{print_seed()};
    std::unique_ptr<AirPass> pass_;
};

constexpr Bounds kRoom{{-3.0, 0.02, -3.0}, {3.0, 2.2, 3.0}};
/// Largest share of wrong places: edges of shadows within a texel, and what bias lifts out of them.
constexpr double kFewWrong = 0.003;

TEST_F(EmbedAir, IsLitWhereRaysFindItLit) {
    add_room();
    struct Case {
        const char* name;
        LightKind kind;
        glm::dvec3 at_m;
        LightShadow shadow;
    };
    const Case cases[] = {{"sun", LightKind::directional, {1.5, 3.0, 1.0}, {}},
                          {"cascades", LightKind::directional, {-1.5, 3.0, 1.0}, {.cascades = 3}},
                          {"spot", LightKind::spot, {-1.5, 3.0, 1.0}, {}},
                          {"point", LightKind::point, {0.4, 1.9, 1.3}, {}}};
    shadows->add_air(box_of(kRoom));
    for (const Case& c : cases) {
        const LightId light = add_shadowed(c.kind, c.at_m, c.shadow);
        const Result result = judged(light, places_in(kRoom));
        std::cout << c.name << ": " << 100.0 * result.wrong_share() << " % wrong, " << result.dark << " of "
                  << result.looked_up.size() << " dark\n";
        EXPECT_LT(result.wrong_share(), kFewWrong) << c.name;
        EXPECT_GT(result.dark, 100u) << c.name;
        EXPECT_GT(result.looked_up.size() - result.dark, 2000u) << c.name;
        shadows->remove(light);
    }
}

// A board high above throws its shadow through the air and beyond the ground.
TEST_F(EmbedAir, DarkenedByACasterThatDarkensNothingElse) {
    add(game::make_card({0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {3.0, 0.0, 0.0}));
    add(game::make_box({2.5, 0.6, -0.8}, {2.6, 1.6, 0.8}));
    shadows->set_caster({1, 1}, {.mesh = {1, 1}, .receives = false});
    const LightId sun = add_shadowed(LightKind::directional, {6.0, 0.3, 0.0});
    const Bounds air{{-2.0, 0.5, -1.5}, {2.0, 1.8, 1.5}};
    const std::vector<glm::dvec3> places = places_in(air);
    const Result undeclared = judged(sun, places);
    EXPECT_GT(undeclared.dark, 1000u);
    EXPECT_EQ(undeclared.wrong, undeclared.dark) << "control: maps hold only what darkens declared receivers";
    const CasterId box = shadows->add_air(box_of(air));
    const Result declared = judged(sun, places);
    EXPECT_LT(declared.wrong_share(), kFewWrong);
    // What casts for the air alone is as if it were not there once the air is gone.
    shadows->set_air(box, box_of({{-2.0, 0.5, 60.0}, {2.0, 1.8, 70.0}}));
    EXPECT_EQ(judged(sun, places).wrong, undeclared.wrong);
    shadows->set_air(box, box_of(air));
    // The map may have texels elsewhere than at first.
    EXPECT_LT(judged(sun, places).wrong_share(), kFewWrong);
    shadows->remove(box);
    // A map that is larger than it need be stays for a second.
    for (int i = 0; i < 200; ++i) shadows->render(view);
    EXPECT_EQ(judged(sun, places).wrong, undeclared.wrong);
}

TEST_F(EmbedAir, IsTheSameWithoutEconomy) {
    add_room();
    shadows->add_air(box_of(kRoom));
    const std::vector<glm::dvec3> places = places_in(kRoom);
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        const LightId light = add_shadowed(kind, {0.4, 1.9, 1.3});
        const Result with = judged(light, places);
        for (int i = 0; i < 40; ++i) shadows->render(view);
        EXPECT_TRUE(shadows->status().still) << "control: nothing is drawn again";
        ShadowTuning tuning;
        tuning.reuse.economy = false;
        shadows->tune(light, tuning);
        EXPECT_EQ(judged(light, places).looked_up, with.looked_up);
        EXPECT_EQ((shadows->render(view), shadows->status().still), false) << "control: without economy all is drawn";
        shadows->remove(light);
    }
}

TEST_F(EmbedAir, OfOtherLayersNeedsNoMap) {
    add_room();
    const LightId sun = add_shadowed(LightKind::directional, {1.5, 3.0, 1.0}, {.layers = 1});
    for (std::uint32_t i = 0; i < room.size(); ++i) shadows->set_caster({i, 1}, {.mesh = {i, 1}, .receives = false});
    AirDesc air = box_of(kRoom);
    air.receive_layers = 2;
    const CasterId box = shadows->add_air(air);
    shadows->render(view);
    EXPECT_EQ(shadows->status(sun).reason, Reason::no_visible_receiver);
    air.receive_layers = 1;
    shadows->set_air(box, air);
    shadows->render(view);
    EXPECT_EQ(shadows->status(sun).state, LightState::rendered);
    View of_others = view;
    of_others.receive_layers = 4;
    shadows->render(of_others);
    EXPECT_EQ(shadows->status(sun).reason, Reason::no_visible_receiver);
}

TEST_F(EmbedAir, WithoutABoxIsReportedAndLeftOut) {
    add_room();
    const AirDesc good = box_of(kRoom);
    const CasterId box = shadows->add_air({.world_from_box = glm::dmat4(std::nan(""))});
    shadows->render(view);
    ASSERT_EQ(shadows->dropped().size(), 1u);
    EXPECT_EQ(shadows->dropped()[0].caster, box);
    EXPECT_EQ(shadows->dropped()[0].reason, "non_finite_transform");
    shadows->set_air(box, {.world_from_box = glm::dmat4(0.0)});
    shadows->render(view);
    ASSERT_EQ(shadows->dropped().size(), 1u);
    EXPECT_EQ(shadows->dropped()[0].reason, "zero_scale");
    shadows->set_air(box, good);
    shadows->render(view);
    EXPECT_TRUE(shadows->dropped().empty()) << "control";
    // Calls for other kinds of casters do nothing to it.
    shadows->set_transform(box, glm::dmat4(0.0));
    shadows->set_caster(box, {});
    shadows->redraw(box, {});
    shadows->set_air({0, 1}, {.world_from_box = glm::dmat4(0.0)});
    shadows->render(view);
    EXPECT_TRUE(shadows->dropped().empty());
    EXPECT_TRUE(shadows->status().still);
}

}  // namespace
}  // namespace gnomon
