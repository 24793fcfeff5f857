#include "engine/mesh/mesh_topology.h"
#include "engine/rays/mesh_bvh.h"
#include "gnomon/components.h"
#include "tests/system/frame_fixture.h"

/// Meshes that bend: once per pose, for all that draw them. Nothing of it is done for other meshes.
namespace gnomon {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Makes a deformer. Vertices above the middle follow the second joint, the others the first. One target lifts all.
std::shared_ptr<const assets::Deformer> two_joints(const assets::Mesh& mesh) {
    assets::Deformer deformer;
    deformer.targets.resize(1);
    for (const assets::Vertex& vertex : mesh.vertices) {
        deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
        deformer.influences.push_back({vertex.position_ms.y > 0.0f ? 1u : 0u, 1.0f});
        deformer.targets[0].positions.emplace_back(0.0f, 1.0f, 0.0f);
    }
    deformer.first_influence.push_back(static_cast<std::uint32_t>(deformer.influences.size()));
    assets::measure(deformer, mesh);
    return std::make_shared<const assets::Deformer>(std::move(deformer));
}

class LivingCasters : public FrameTest {
protected:
    static constexpr std::uint32_t kBending = kSolidBox + 1;

    void SetUp() override {
        library.meshes.push_back(library.meshes[kSolidBox]);
        library.meshes[kBending].deformer = two_joints(library.meshes[kBending]);
        FrameTest::SetUp();
        stage = world.add_stage();
        lower = world.registry.create();
        upper = world.registry.create();
        world.registry.emplace<Transform>(lower, {{2.0, 1.0, 0.0}});
        world.registry.emplace<Transform>(upper, {{2.0, 1.0, 0.0}});
        body = world.add_mesh(kBending, {100.0, 0.0, 0.0}, true);
        world.registry.emplace<Skin>(body, {{lower, upper}, {glm::dmat4x3(1.0), glm::dmat4x3(1.0)}});
    }
    void bend(double by_m) {
        world.registry.patch<Transform>(upper, [&](Transform& t) { t.translation_m.x = 2.0 + by_m; });
    }
    /// Uploads of the last frame into the buffer of that label.
    std::vector<gl::UpdateBuffer> uploads(const std::string& label) const {
        std::vector<gl::UpdateBuffer> found;
        for (const gl::Command& c : frame->commands().commands) {
            const auto* update = std::get_if<gl::UpdateBuffer>(&c);
            if (update && device.buffer(update->buffer)->label == label) found.push_back(*update);
        }
        return found;
    }
    /// Returns the values of the mesh in such an upload, which must be the only one.
    template <class T>
    std::vector<T> uploaded(const std::string& label) const {
        const auto found = uploads(label);
        EXPECT_THAT(found, SizeIs(1)) << label;
        if (found.size() != 1) return {};
        std::vector<T> values(found[0].size / sizeof(T));
        std::memcpy(values.data(), frame->commands().bytes.data() + found[0].first, found[0].size);
        return values;
    }
    const InstanceItem& item() const {
        for (const InstanceItem& i : frame->snapshot().instances)
            if (i.entity == body) return i;
        ADD_FAILURE() << "the body is not listed";
        return frame->snapshot().instances.front();
    }
    void expect_nothing_bent() const {
        for (const char* label : {"scene vertices", "triangle normals", "caster triangles"})
            EXPECT_THAT(uploads(label), IsEmpty()) << label;
    }

    TestWorld::Stage stage;
    ecs::Entity lower, upper, body;
};

TEST_F(LivingCasters, AreBentOncePerPoseWhateverTheLightsAndViews) {
    for (const LightKind kind : {LightKind::directional, LightKind::spot, LightKind::point}) {
        const ecs::Entity light =
            world.add_light(kind, kLightPlace_m, "light" + std::to_string(static_cast<int>(kind)));
        world.registry.patch<LightShadow>(light, [](LightShadow& s) { s.filter = ShadowFilter::triangles; });
    }
    step();
    EXPECT_THAT(uploads("scene vertices"), SizeIs(1)) << "the first pose";
    bend(0.5);
    step();
    EXPECT_GE(depth_passes().size(), 3u) << "one per light at least";
    const auto vertices = uploaded<assets::Vertex>("scene vertices");
    EXPECT_THAT(vertices, SizeIs(library.meshes[kBending].vertices.size()));
    EXPECT_THAT(uploaded<glm::vec4>("triangle normals"), SizeIs(library.meshes[kBending].indices.size() / 3));
    EXPECT_THAT(uploaded<CasterTriangle>("caster triangles"), SizeIs(library.meshes[kBending].indices.size() / 3));
}

TEST_F(LivingCasters, InTheTreesThatRaysAskAreWrittenWhereTheyBentAlone) {
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    world.registry.patch<LightShadow>(lamp, [](LightShadow& s) { s.filter = ShadowFilter::exact; });
    step();
    EXPECT_EQ(frame->report().rays.triangles, 24u);
    bend(0.5);
    step();
    EXPECT_EQ(frame->report().rays.meshes_written, 1u);
    EXPECT_TRUE(frame->report().rays.instances_written) << "what is around it";
    const auto triangles = uploaded<rays::BvhTriangle>("ray triangles");
    ASSERT_THAT(triangles, SizeIs(library.meshes[kBending].indices.size() / 3));
    const auto reaches = [](const rays::BvhTriangle& t) { return std::max({t.a.x, t.b.x, t.c.x}); };
    float farthest_m = 0.0f;
    for (const rays::BvhTriangle& triangle : triangles) farthest_m = std::max(farthest_m, reaches(triangle));
    EXPECT_NEAR(farthest_m, 1.0, 1e-5) << "half a metre, and half a metre more";
    step();
    EXPECT_EQ(frame->report().rays.meshes_written, 0u);
    EXPECT_THAT(uploads("ray triangles"), IsEmpty());
}

TEST_F(LivingCasters, StandStillForNothing) {
    world.add_light(LightKind::spot, kLightPlace_m, "spot");
    step();
    for (int i = 0; i < 3; ++i) {
        step();
        expect_nothing_bent();
        EXPECT_EQ(light("spot").state, LightState::reused);
    }
    world.move(stage.camera, {0.5, 4.0, 8.0});
    world.move(body, {50.0, 0.0, 0.0});  // where the mesh's own entity is does not count
    step();
    expect_nothing_bent();
    EXPECT_EQ(light("spot").state, LightState::reused);
    bend(0.0);  // touched, and yet the same
    step();
    expect_nothing_bent();
    EXPECT_EQ(light("spot").state, LightState::reused);
}

TEST_F(LivingCasters, AreRedrawnByThoseMapsThatShowThemWhenTheirPoseChanges) {
    world.add_light(LightKind::spot, {2.0, 6.0, 0.5}, "above");
    const ecs::Entity elsewhere = world.add_light(LightKind::spot, {-3.0, 6.0, 0.0}, "elsewhere");
    world.registry.patch<Transform>(
        elsewhere, [](Transform& t) { t.rotation = glm::quatLookAt(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1)); });
    world.registry.patch<Light>(elsewhere, [](Light& l) { l.outer_cone_rad = 0.6f; });
    step();
    step();
    EXPECT_EQ(light("above").state, LightState::reused);
    bend(0.25);
    step();
    EXPECT_EQ(light("above").state, LightState::rendered);
    EXPECT_NE(light("elsewhere").state, LightState::rendered);
    world.registry.emplace<MorphWeights>(body, {{0.5f}});
    step();
    EXPECT_EQ(light("above").state, LightState::rendered);
    world.registry.patch<MorphWeights>(body, [](MorphWeights& m) { m.weights = {0.75f}; });
    step();
    EXPECT_EQ(light("above").state, LightState::rendered);
    EXPECT_THAT(uploads("scene vertices"), SizeIs(1));
}

TEST_F(LivingCasters, LieWithinTheBoundsThatAllStagesWorkWith) {
    world.registry.emplace<MorphWeights>(body, {{0.5f}});
    for (const double by_m : {0.0, 0.7, -3.0, 40.0}) {
        SCOPED_TRACE(by_m);
        bend(by_m);
        world.registry.patch<Transform>(upper, [&](Transform& t) {
            t.rotation = glm::angleAxis(by_m, glm::dvec3(0.6, 0.0, 0.8));
            t.scale = {1.0, 2.0, -1.0};
        });
        step();
        math::Aabb held;
        for (const assets::Vertex& v : uploaded<assets::Vertex>("scene vertices")) {
            const glm::dvec3 at = item().basis * glm::dvec3(v.position_ms) + item().translation_ws_m;
            held = math::extended(held, at);
        }
        const math::Aabb& box = item().bounds_ws;
        EXPECT_EQ(math::merged(box, held), box);
        EXPECT_TRUE(item().winding.folded) << "one of two joints mirrors";
        EXPECT_FALSE(item().winding.mirrored);
    }
    world.registry.patch<Transform>(lower, [](Transform& t) { t.scale.x = -1.0; });
    step();
    EXPECT_TRUE(item().winding.mirrored);
    EXPECT_FALSE(item().winding.folded);
}

TEST_F(LivingCasters, StandWhereTheirJointsAreFarFromTheOriginToo) {
    for (const ecs::Entity joint : {lower, upper}) world.move(joint, {1.0e7, 2.0, -3.0e6});
    step();
    EXPECT_EQ(item().translation_ws_m, glm::dvec3(1.0e7, 2.0, -3.0e6));
    const auto vertices = uploaded<assets::Vertex>("scene vertices");
    for (std::size_t v = 0; v < vertices.size(); ++v)
        EXPECT_EQ(vertices[v].position_ms, library.meshes[kBending].vertices[v].position_ms) << "exact, so far away";
}

TEST_F(LivingCasters, AreAtRestAgainWithoutSkinAndWeights) {
    bend(0.5);
    step();
    EXPECT_NE(uploaded<assets::Vertex>("scene vertices"), library.meshes[kBending].vertices);
    world.registry.remove<Skin>(body);
    step();
    EXPECT_EQ(uploaded<assets::Vertex>("scene vertices"), library.meshes[kBending].vertices);
    EXPECT_EQ(item().translation_ws_m, glm::dvec3(100.0, 0.0, 0.0));
    step();
    expect_nothing_bent();
}

TEST_F(LivingCasters, AreUploadedAgainAfterASubmissionThatFailed) {
    step();
    bend(0.5);
    device.fail_call(device.calls(), gl::Failure::out_of_memory);
    step();
    ASSERT_NE(frame->report().failure, gl::Failure::none);
    step();
    EXPECT_THAT(uploads("scene vertices"), SizeIs(1));
    step();
    expect_nothing_bent();
}

TEST_F(LivingCasters, ShowTrianglesTheSameCornersAlsoToALightThatComesLater) {
    bend(0.5);
    step();
    const auto vertices = uploaded<assets::Vertex>("scene vertices");
    const ecs::Entity spot = world.add_light(LightKind::spot, kLightPlace_m, "spot");
    world.registry.patch<LightShadow>(spot, [](LightShadow& s) { s.filter = ShadowFilter::triangles; });
    step();
    gl::BufferHandle triangles{};
    for (const gl::Command& c : frame->commands().commands)
        if (const auto* bind = std::get_if<gl::BindTexels>(&c);
            bind && device.buffer(bind->buffer)->label == "caster triangles")
            triangles = bind->buffer;
    const auto bytes = device.buffer_bytes(triangles);
    const std::vector<std::uint32_t>& indices = library.meshes[kBending].indices;
    ASSERT_GE(bytes.size(), indices.size() / 3 * sizeof(CasterTriangle));
    std::vector<CasterTriangle> last(indices.size() / 3);  // the bending mesh is the library's last
    std::memcpy(last.data(), bytes.data() + bytes.size() - last.size() * sizeof(CasterTriangle),
                last.size() * sizeof(CasterTriangle));
    for (std::size_t i = 0; i < indices.size(); ++i)
        EXPECT_EQ(last[i / 3].corners[i % 3].position_ms, vertices[indices[i]].position_ms);
}

TEST_F(LivingCasters, WithAJointThatIsGoneKeepWhatFollowsItAtRest) {
    bend(0.5);
    step();
    world.registry.destroy(upper);
    step();
    EXPECT_EQ(item().translation_ws_m, glm::dvec3(2.0, 1.0, 0.0));
    EXPECT_TRUE(math::is_finite(item().bounds_ws));
}

TEST_F(LivingCasters, NobodyElsePaysForThem) {
    const assets::MeshLibrary plain = test_library();
    gl::RecordingDevice other;
    {
        auto made = FrameSystem::create(other, plain);
        ASSERT_TRUE(made);
        TestWorld still;
        still.add_stage();
        still.add_light(LightKind::spot, kLightPlace_m, "spot");
        made.value()->run(still.registry, settings);
        for (const gl::Command& c : made.value()->commands().commands) {
            const auto* bind = std::get_if<gl::BindMeshes>(&c);
            if (!bind) continue;
            EXPECT_EQ(other.buffer(bind->vertices)->use, gl::BufferUse::fixed);
        }
        EXPECT_THAT(made.value()->snapshot().poses, IsEmpty());
        EXPECT_EQ(other.live_bytes(), [&] {
            // The same with a mesh that could bend, but has no entity.
            gl::RecordingDevice third;
            assets::MeshLibrary bending = test_library();
            bending.meshes[kSolidBox].deformer = two_joints(bending.meshes[kSolidBox]);
            auto with = FrameSystem::create(third, bending);
            with.value()->run(still.registry, settings);
            EXPECT_EQ(gl::to_text(with.value()->commands()), gl::to_text(made.value()->commands()));
            return third.live_bytes();
        }());
    }
}

}  // namespace
}  // namespace gnomon
