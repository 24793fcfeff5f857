#include <algorithm>
#include <deque>

#include "gnomon/components.h"
#include "systems/frame_timers.h"
#include "tests/system/frame_fixture.h"

/// What a frame takes from others, and what it gives to them.
namespace gnomon {
namespace {

using ::testing::ElementsAre;

using OtherReaders = FrameTest;

TEST_F(OtherReaders, FindTheirChangesWhateverFramesRanMeanwhile) {
    const TestWorld::Stage stage = world.add_stage();
    const ecs::Entity lamp = world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    step();
    ecs::ChangeCursor transforms, lights, meshes;
    world.registry.changes<Transform>(transforms);
    world.registry.changes<Light>(lights);
    world.registry.changes<MeshRef>(meshes);
    world.move(stage.box, {0.1, 1, 0});
    step();
    world.registry.patch<Light>(lamp, [](Light& l) { l.intensity = 7.0f; });
    step();
    step();
    world.registry.remove<MeshRef>(stage.box);
    step();
    const ecs::Changes moved = world.registry.changes<Transform>(transforms);
    EXPECT_TRUE(moved.complete);
    EXPECT_THAT(moved.entries, ElementsAre(ecs::Change{stage.box, ecs::ChangeKind::changed}));
    const ecs::Changes lit = world.registry.changes<Light>(lights);
    EXPECT_TRUE(lit.complete);
    EXPECT_THAT(lit.entries, ElementsAre(ecs::Change{lamp, ecs::ChangeKind::changed}));
    const ecs::Changes shown = world.registry.changes<MeshRef>(meshes);
    EXPECT_TRUE(shown.complete);
    EXPECT_THAT(shown.entries, ElementsAre(ecs::Change{stage.box, ecs::ChangeKind::removed}));
}

TEST_F(OtherReaders, MayBeASecondFrameOfTheSameWorld) {
    const TestWorld::Stage stage = world.add_stage();
    world.add_light(LightKind::spot, kLightPlace_m, "lamp");
    auto second = FrameSystem::create(device, library);
    ASSERT_TRUE(second);
    for (int i = 0; i < 3; ++i) {
        step();
        second.value()->run(world.registry, settings);
    }
    const std::uint64_t lists = second.value()->snapshot().list_version;
    for (int i = 0; i < 5; ++i) {
        world.move(stage.box, {0.1 * i, 1, 0});
        step();
        second.value()->run(world.registry, settings);
        for (const FrameSystem* of : {frame.get(), second.value().get()}) {
            const std::vector<InstanceItem>& items = of->snapshot().instances;
            const auto box = std::find_if(items.begin(), items.end(),
                                          [&](const InstanceItem& item) { return item.entity == stage.box; });
            ASSERT_NE(box, items.end());
            EXPECT_EQ(box->translation_ws_m, glm::dvec3(0.1 * i, 1, 0));
        }
        EXPECT_EQ(second.value()->snapshot().list_version, lists) << "it was told what moved";
    }
}

/// A device with timers of each light's work, for its maps and for its lighting. Each reports as many microseconds as
/// the index of the light's entity, and one more.
class LateTimers : public ::testing::Test {
protected:
    class Device final : public gl::Device {
    public:
        gl::RecordingDevice recording;
        std::vector<double> us;  // by light of the frame that is submitted next
        std::deque<std::vector<gl::Timing>> answers;
        std::size_t late = 2;

        const gl::DeviceInfo& info() const override { return recording.info(); }
        std::uint64_t compiled_programs() const override { return recording.compiled_programs(); }
        gl::Created<gl::TextureHandle> create_texture(const gl::TextureDesc& d,
                                                      std::span<const std::byte> b) override {
            return recording.create_texture(d, b);
        }
        gl::Created<gl::SamplerHandle> create_sampler(const gl::SamplerDesc& d) override {
            return recording.create_sampler(d);
        }
        gl::Created<gl::BufferHandle> create_buffer(const gl::BufferDesc& d, std::span<const std::byte> b) override {
            return recording.create_buffer(d, b);
        }
        gl::Created<gl::ProgramHandle> create_program(const gl::ProgramDesc& d) override {
            return recording.create_program(d);
        }
        gl::Created<gl::TargetHandle> create_target(const gl::TargetDesc& d) override {
            return recording.create_target(d);
        }
        void destroy(gl::TextureHandle h) override { recording.destroy(h); }
        void destroy(gl::SamplerHandle h) override { recording.destroy(h); }
        void destroy(gl::BufferHandle h) override { recording.destroy(h); }
        void destroy(gl::ProgramHandle h) override { recording.destroy(h); }
        void destroy(gl::TargetHandle h) override { recording.destroy(h); }
        gl::SubmitResult submit(const gl::CommandList& list) override {
            const gl::SubmitResult result = recording.submit(list);
            std::vector<gl::Timing>& now = answers.emplace_back();
            for (const gl::Command& command : list.commands) {
                const auto* timer = std::get_if<gl::BeginTimer>(&command);
                if (timer && timer->id < kSurfaceTimer)
                    now.push_back({timer->id, result.submission, us.at(timer->id / 2)});
            }
            return result;
        }
        bool read_texture(gl::TextureHandle t, std::uint32_t l, std::span<std::byte> out) override {
            return recording.read_texture(t, l, out);
        }
        gl::Readback read_buffer(gl::BufferHandle b, std::span<std::byte> out) override {
            return recording.read_buffer(b, out);
        }
        void set_timing(gl::TimingMode) override {}
        std::vector<gl::Timing> take_timings() override {
            if (answers.size() <= late) return {};
            std::vector<gl::Timing> oldest = std::move(answers.front());
            answers.pop_front();
            return oldest;
        }
        void finish() override {}
    };

    void SetUp() override {
        world.add_stage();
        auto made = FrameSystem::create(device, library);
        ASSERT_TRUE(made);
        frame = std::move(made).value();
    }
    ecs::Entity add(const std::string& name) { return world.add_light(LightKind::spot, kLightPlace_m, name); }
    static double own_us(ecs::Entity light) { return 1.0 + light.index; }
    void step() {
        device.us.clear();
        for (const ecs::Entity e : world.registry.entities_with<Light>()) device.us.push_back(own_us(e));
        std::sort(device.us.begin(), device.us.end());  // lights are in the order of their entities
        frame->run(world.registry, {.viewport_px = {64, 36}, .exposure_ev = {}});
    }
    std::optional<double> told_us(ecs::Entity light) const {
        for (const LightReport& l : frame->report().lights)
            if (l.entity == light) return l.gpu_us;
        ADD_FAILURE() << "no such light";
        return std::nullopt;
    }
    Device device;
    assets::MeshLibrary library = test_library();
    TestWorld world;
    std::unique_ptr<FrameSystem> frame;
};

TEST_F(LateTimers, GoToTheLightThatWasMeasuredWhenAnotherHasItsIndex) {
    const ecs::Entity hole = world.registry.create();
    const ecs::Entity first = add("first"), second = add("second"), third = add("third");
    for (int i = 0; i < 4; ++i) step();
    for (const ecs::Entity light : {first, second, third}) EXPECT_EQ(told_us(light), own_us(light));

    world.registry.destroy(first);  // the others are one place nearer the front now
    for (std::size_t i = 0; i <= device.late; ++i) {
        step();
        EXPECT_EQ(told_us(second), own_us(second)) << i;
        EXPECT_EQ(told_us(third), own_us(third)) << i;
    }

    world.registry.destroy(hole);
    const ecs::Entity before = add("before"), early = add("early");
    ASSERT_LT(std::min(before.index, early.index), second.index) << "it stands before the others";
    for (std::size_t i = 0; i < device.late; ++i) {
        step();
        EXPECT_EQ(told_us(before), std::nullopt) << "it has not been measured yet";
        EXPECT_EQ(told_us(early), std::nullopt);
        EXPECT_EQ(told_us(second), own_us(second)) << i;
        EXPECT_EQ(told_us(third), own_us(third)) << i;
    }
    step();
    for (const ecs::Entity light : {before, early, second, third}) EXPECT_TRUE(told_us(light).has_value());
}

TEST_F(LateTimers, OfALightThatIsGoneAreInTheSumOfItsFrameAlone) {
    const ecs::Entity first = add("first"), second = add("second");
    for (int i = 0; i < 4; ++i) step();
    const double both_us = *frame->report().gpu_us;
    world.registry.destroy(first);
    step();
    EXPECT_EQ(told_us(second), own_us(second));
    EXPECT_EQ(frame->report().gpu_us, both_us);
}

TEST_F(LateTimers, OfSubmissionsThatAreNoFramesMeanNothing) {
    const ecs::Entity lamp = add("lamp");
    for (int i = 0; i < 4; ++i) step();
    for (auto& answer : device.answers) answer = {{lighting_timer(0), 1000000, 99.0}};
    step();
    EXPECT_EQ(told_us(lamp), std::nullopt);
    EXPECT_EQ(frame->report().gpu_us, std::nullopt);
}

}  // namespace
}  // namespace gnomon
