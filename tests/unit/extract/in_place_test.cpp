#include <gmock/gmock.h>

#include <functional>

#include "gnomon/components.h"
#include "tests/unit/allocation_counter.h"
#include "tests/unit/extract/extracted_world.h"

/// What is written while nothing comes or goes: brought into the snapshot where it is, and nothing else is looked at.
namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kLongName = "a name that is longer than any string holds within itself";

class InPlace : public ExtractedWorldTest {
protected:
    void SetUp() override {
        stage = world.add_stage();
        for (int i = 0; i < 200; ++i) boxes.push_back(world.add_mesh(kBox, {3.0 * i, 0, 0}, i % 2 == 0));
        world.registry.emplace<Name>(stage.camera, {kLongName});
        world.registry.emplace<Name>(stage.box, {kLongName});
        lamp = world.add_light(LightKind::spot, kLightPlace_m, kLongName);
        world.add_light(LightKind::directional, {0, 9, 1}, "sun");
        other = world.add_light(LightKind::point, {5, 5, 5}, kLongName);
        update();
        lists = snapshot.list_version;
    }
    struct Edit {
        const char* what;
        std::function<void()> run;
        bool shapes_lamp = false;  // the lamp's shadows follow from it
    };
    /// Returns edits of each component that does not concern instances.
    std::vector<Edit> edits() {
        ecs::Registry& r = world.registry;
        return {
            {"intensity", [&] { r.patch<Light>(lamp, [](Light& l) { l.intensity *= 0.99f; }); }},
            {"cone", [&] { r.patch<Light>(lamp, [](Light& l) { l.outer_cone_rad *= 0.99f; }); }, true},
            {"size", [&] { r.patch<Light>(lamp, [](Light& l) { l.source_radius_m = 0.1f; }); }, true},
            {"kind", [&] { r.patch<Light>(other, [](Light& l) { l.kind = LightKind::directional; }); }},
            {"shadow", [&] { r.patch<LightShadow>(lamp, [](LightShadow& s) { s.resolution_px += 1; }); }, true},
            {"tuning", [&] { r.emplace<ShadowTuning>(lamp, {.kernel = {.taps = 3}}); }, true},
            {"other tuning", [&] { r.patch<ShadowTuning>(lamp, [](ShadowTuning& t) { t.kernel.taps = 4; }); }, true},
            {"no tuning", [&] { r.remove<ShadowTuning>(lamp); }, true},
            {"no shadow", [&] { r.remove<LightShadow>(other); }},
            {"shadow again", [&] { r.emplace<LightShadow>(other); }},
            {"camera", [&] { r.patch<Camera>(stage.camera, [](Camera& c) { c.fov_y_rad *= 0.99; }); }},
            {"light's name", [&] { r.patch<Name>(other, [](Name& n) { n.text = "other"; }); }},
            {"the same name twice", [&] { r.patch<Name>(other, [](Name& n) { n.text = kLongName; }); }},
            {"camera's name", [&] { r.patch<Name>(stage.camera, [](Name& n) { n.text = "eye"; }); }},
            {"no name", [&] { r.remove<Name>(lamp); }},
        };
    }
    TestWorld::Stage stage;
    std::vector<ecs::Entity> boxes;
    ecs::Entity lamp, other;
    std::uint64_t lists = 0;
};

TEST_F(InPlace, LightsShadowsCamerasAndNamesLeaveInstancesAlone) {
    const std::vector<std::uint64_t> versions = instance_versions();
    for (const Edit& edit : edits()) {
        const std::uint64_t version = snapshot.version;
        edit.run();
        update();
        EXPECT_EQ(snapshot.version, version + 1) << edit.what;
        EXPECT_EQ(snapshot.list_version, lists) << edit.what;
        EXPECT_EQ(instance_versions(), versions) << edit.what;
        EXPECT_THAT(snapshot.changed_instances, IsEmpty()) << edit.what;
        expect_as_if_made_anew(edit.what);
    }
    const auto added = world.add_mesh(kBox, {0, 0, 9}, true);
    update();
    EXPECT_GT(snapshot.list_version, lists) << "the control: " << added.index;
}

TEST_F(InPlace, TuningHoldsWhileItIsThereAndIsTheDefaultsWithoutIt) {
    ecs::Registry& r = world.registry;
    const auto taps = [&] { return snapshot.lights.at(0).tuning.kernel.taps; };
    const std::uint32_t usual = ShadowTuning{}.kernel.taps;
    EXPECT_EQ(taps(), usual);
    r.emplace<ShadowTuning>(lamp, {.kernel = {.taps = 3}});
    update();
    EXPECT_EQ(taps(), 3u);
    r.patch<ShadowTuning>(lamp, [](ShadowTuning& t) { t.kernel.taps = 4; });
    update();
    EXPECT_EQ(taps(), 4u);
    r.remove<ShadowTuning>(lamp);
    update();
    EXPECT_EQ(taps(), usual);
    EXPECT_EQ(snapshot.list_version, lists);
}

TEST_F(InPlace, TuningByTheDefaultsOrWithoutAShadowChangesNothing) {
    ecs::Registry& r = world.registry;
    const std::uint64_t version = snapshot.version;
    r.emplace<ShadowTuning>(lamp);
    update();
    EXPECT_EQ(snapshot.version, version);
    r.remove<LightShadow>(other);
    update();
    const std::uint64_t without = snapshot.version;
    r.emplace<ShadowTuning>(other, {.kernel = {.taps = 3}});
    r.patch<ShadowTuning>(other, [](ShadowTuning& t) { t.bias.mode = BiasMode::slope; });
    update();
    EXPECT_EQ(snapshot.version, without);
    r.emplace<LightShadow>(other);
    update();
    EXPECT_GT(snapshot.version, without) << "the control";
    EXPECT_EQ(snapshot.lights.at(2).tuning.kernel.taps, 3u);
    expect_as_if_made_anew("a shadow again");
}

TEST_F(InPlace, AnotherLightThatComesOrGoesLeavesInstancesAloneToo) {
    ecs::Registry& r = world.registry;
    for (const Edit& edit : std::vector<Edit>{
             {"absurd", [&] { r.patch<Light>(lamp, [](Light& l) { l.intensity = -1.0f; }); }},
             {"absurd by another name", [&] { r.emplace<Name>(lamp, {"sick"}); }},
             {"mended", [&] { r.patch<Light>(lamp, [](Light& l) { l.intensity = 1.0f; }); }},
             {"on a box", [&] { r.emplace<Light>(boxes[3]); }},
             {"not on a box", [&] { r.remove<Light>(boxes[3]); }},
             {"camera off", [&] { r.patch<Camera>(stage.camera, [](Camera& c) { c.active = false; }); }},
             {"camera on", [&] { r.patch<Camera>(stage.camera, [](Camera& c) { c.active = true; }); }},
             {"absurd camera", [&] { r.patch<Camera>(stage.camera, [](Camera& c) { c.near_m = -1.0; }); }},
         }) {
        const std::uint64_t version = snapshot.version, sun = snapshot.lights.at(1).shape_version;
        edit.run();
        update();
        EXPECT_EQ(snapshot.version, version + 1) << edit.what;
        EXPECT_EQ(snapshot.list_version, lists) << edit.what;
        EXPECT_THAT(snapshot.changed_instances, IsEmpty()) << edit.what;
        const auto same = std::find_if(snapshot.lights.begin(), snapshot.lights.end(),
                                       [](const LightItem& l) { return l.name == "sun"; });
        if (edit.what != std::string("absurd")) {
            EXPECT_LE(same->shape_version, sun) << edit.what;
        }
        expect_as_if_made_anew(edit.what);
    }
}

TEST_F(InPlace, LightsKeepTheirVersionsWhenOthersComeAndGo) {
    const std::uint64_t shape = snapshot.lights.at(0).shape_version;
    const ecs::Entity added = world.add_light(LightKind::point, {1, 1, 1}, "added");
    update();
    EXPECT_EQ(snapshot.lights.at(0).shape_version, shape);
    EXPECT_EQ(snapshot.lights.back().shape_version, snapshot.version);
    world.registry.destroy(added);
    world.add_mesh(kBox, {0, 7, 0}, true);
    update();
    EXPECT_EQ(snapshot.lights.at(0).shape_version, shape);
}

TEST_F(InPlace, DimmingAndNamingChangeNothingThatShadowsFollowFrom) {
    std::uint64_t shape = snapshot.lights.at(0).shape_version;
    for (const Edit& edit : edits()) {
        edit.run();
        update();
        EXPECT_EQ(snapshot.lights.at(0).shape_version > shape, edit.shapes_lamp) << edit.what;
        shape = snapshot.lights.at(0).shape_version;
    }
    world.move(lamp, {1, 2, 3});
    update();
    EXPECT_GT(snapshot.lights.at(0).shape_version, shape);
}

TEST_F(InPlace, WhatIsWrittenAsItWasChangesNothing) {
    const std::uint64_t version = snapshot.version;
    ecs::Registry& r = world.registry;
    r.patch<Light>(lamp, [](Light&) {});
    r.emplace<ShadowTuning>(lamp);
    r.patch<LightShadow>(lamp, [](LightShadow&) {});
    r.patch<ShadowTuning>(lamp, [](ShadowTuning&) {});
    r.patch<Camera>(stage.camera, [](Camera&) {});
    r.patch<Name>(lamp, [](Name&) {});
    r.patch<Name>(stage.box, [](Name& n) { n.text = "nobody asks for a box's"; });
    r.patch<MeshRef>(stage.box, [](MeshRef&) {});
    r.patch<ShadowCaster>(stage.box, [](ShadowCaster&) {});
    update();
    EXPECT_EQ(snapshot.version, version);
    EXPECT_TRUE(has_tree(snapshot));
    r.patch<Light>(lamp, [](Light& l) { l.colour.r = 0.5f; });
    update();
    EXPECT_EQ(snapshot.version, version + 1) << "the control";
}

TEST_F(InPlace, WhatInstancesShowAndCastIsWrittenWithoutMakingListsAnew) {
    ecs::Registry& r = world.registry;
    const std::vector<std::uint64_t> versions = instance_versions();
    const std::vector<Edit> marks = {
        {"casts not", [&] { r.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.enabled = false; }); }},
        {"no caster", [&] { r.remove<ShadowCaster>(stage.box); }},
        {"a caster", [&] { r.emplace<ShadowCaster>(stage.box); }},
        {"layers", [&] { r.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_layers = 2; }); }},
        {"hidden", [&] { r.patch<MeshRef>(stage.box, [](MeshRef& m) { m.visible = false; }); }},
        {"catching", [&] { r.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_catcher = true; }); }},
    };
    for (const Edit& edit : marks) {
        edit.run();
        const std::size_t before = allocation_count();
        update();
        EXPECT_LE(allocation_count() - before, 4u) << edit.what << ": lists grow to hold one";
        EXPECT_EQ(instance_versions(), versions) << edit.what;
        expect_as_if_made_anew(edit.what);
    }
    EXPECT_EQ(snapshot.list_version, snapshot.version) << "who lists casters has to look again";
    r.patch<MeshRef>(stage.box, [](MeshRef& m) { m.mesh = kMaskedBox; });
    world.move(stage.box, {0, 2, 0});
    update();
    EXPECT_THAT(snapshot.changed_instances, ElementsAre(1u));
    expect_as_if_made_anew("another mesh");
}

TEST_F(InPlace, AMovedOneThatAlsoCastsOtherwiseIsUploadedOnce) {
    world.move(stage.box, {0, 3, 0});
    world.registry.patch<ShadowCaster>(stage.box, [](ShadowCaster& c) { c.layers = 2; });
    world.registry.patch<MeshRef>(stage.box, [](MeshRef& m) { m.shadow_layers = 2; });
    update();
    EXPECT_THAT(snapshot.changed_instances, ElementsAre(1u));
    expect_as_if_made_anew("both");
}

TEST_F(InPlace, NothingIsAllocatedOnceWarm) {
    const auto frame = [&](int i) {
        ecs::Registry& r = world.registry;
        r.patch<Light>(lamp, [&](Light& l) { l.intensity = 1.0f + 0.01f * static_cast<float>(i); });
        r.patch<LightShadow>(lamp, [&](LightShadow& s) { s.resolution_px = static_cast<std::uint32_t>(64 + i); });
        edit_light(r, lamp, [&](ShadowTuning& t) { t.kernel.taps = static_cast<std::uint32_t>(i); });
        r.patch<Camera>(stage.camera, [&](Camera& c) { c.fov_y_rad = 0.9 + 0.001 * i; });
        r.patch<Name>(stage.box, [&](Name& n) { n.text[0] = static_cast<char>('a' + i); });
        r.patch<ShadowCaster>(stage.box, [&](ShadowCaster& c) { c.enabled = i % 2 == 0; });
        update();
    };
    for (int i = 0; i < 3; ++i) frame(i);
    const std::size_t before = allocation_count();
    for (int i = 3; i < 20; ++i) frame(i);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(snapshot.lights.at(0).shadow.resolution_px, 83u);
}

}  // namespace
}  // namespace gnomon
