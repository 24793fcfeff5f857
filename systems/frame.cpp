#include "gnomon/frame.h"

#include <algorithm>
#include <utility>

#include "engine/core/workers.h"
#include "engine/gl/device_gl45.h"
#include "systems/frame_system.h"
#include "systems/visibility/caster_trees.h"
#include "systems/visibility/light_queries.h"

namespace gnomon {

struct Frame::State {
    State(std::unique_ptr<gl::Device> gl_device, std::unique_ptr<Workers> threads,
          std::unique_ptr<FrameSystem> frame_system, const assets::MeshLibrary& library)
        : device(std::move(gl_device)),
          info{device->info().name, device->info().max_texture_px},
          workers(std::move(threads)),
          system(std::move(frame_system)),
          trees(library),
          queries(trees) {}

    /// Returns the light's index in the last frame; their number if it is none.
    std::size_t index_of(ecs::Entity light) const {
        const std::vector<LightItem>& lights = system->snapshot().lights;
        const auto is_it = [&](const LightItem& item) { return item.entity == light; };
        return static_cast<std::size_t>(std::find_if(lights.begin(), lights.end(), is_it) - lights.begin());
    }

    /// Times the device's work while settings or a budget need it.
    void set_timing(const FrameSettings& settings) {
        const bool learns = settings.shadow_budget.gpu_ms > 0.0f && !device->info().is_software;
        const bool wanted = settings.time_gpu || learns;
        if (wanted == is_timed) return;
        using Mode = gl::TimingMode;
        device->set_timing(!wanted ? Mode::off : device->info().is_software ? Mode::finish : Mode::query);
        is_timed = wanted;
    }

    std::unique_ptr<gl::Device> device;
    FrameDevice info;
    std::unique_ptr<Workers> workers;
    std::unique_ptr<FrameSystem> system;
    visibility::CasterTrees trees;
    visibility::LightQueries queries;
    bool is_timed = false;
};

Frame::Frame(std::unique_ptr<State> state) : state_(std::move(state)) {}
Frame::~Frame() = default;

Result<std::unique_ptr<Frame>> Frame::create(const assets::MeshLibrary& library, const FrameOptions& options) {
    gl::MessageSink sink;
    if (options.message)
        sink = [message = options.message](gl::MessageSeverity, std::string_view text) { message(text); };
    auto device = gl::make_gl45_device(std::move(sink), {.keeps_state = true});
    if (!device) return device.error();
    auto workers = std::make_unique<Workers>(options.threads);
    auto system = FrameSystem::create(*device.value(), library, options.history ? *options.history : shadow::History{},
                                      workers.get());
    if (!system) return system.error();
    return std::unique_ptr<Frame>(new Frame(
        std::make_unique<State>(std::move(device).value(), std::move(workers), std::move(system).value(), library)));
}

void Frame::run(ecs::Registry& world, const FrameSettings& settings) {
    state_->set_timing(settings);
    state_->system->run(world, settings);
}

const FrameReport& Frame::report() const { return state_->system->report(); }
const FrameDevice& Frame::device() const { return state_->info; }

unsigned Frame::picture_texture() const { return gl::gl_name(*state_->device, state_->system->picture_texture()); }

bool Frame::read_picture(std::vector<std::uint8_t>& rgba) { return state_->system->read_picture(rgba); }

bool Frame::read_visibility(ecs::Entity light, std::vector<float>& values) {
    const std::size_t index = state_->index_of(light);
    if (index >= state_->system->snapshot().lights.size()) return false;
    return state_->system->read_visibility(static_cast<std::uint32_t>(index), values);
}

bool Frame::read_tint(ecs::Entity light, std::vector<glm::vec4>& values) {
    const std::size_t index = state_->index_of(light);
    if (index >= state_->system->snapshot().lights.size()) return false;
    return state_->system->read_tint(static_cast<std::uint32_t>(index), values);
}

float Frame::visibility(ecs::Entity light, const glm::dvec3& position_m, double radius_m) {
    const SceneSnapshot& scene = state_->system->snapshot();
    const std::size_t index = state_->index_of(light);
    if (index >= scene.lights.size()) return 0.0f;
    const visibility::Place place{position_m, radius_m};
    float answer = 0.0f;
    state_->queries.ask(scene, scene.lights[index], {&place, 1}, {}, {&answer, 1});
    return answer;
}

const std::vector<debug::Label>& Frame::debug_labels() const { return state_->system->debug_labels(); }

std::shared_ptr<const shadow::History> Frame::history() const {
    return std::make_shared<const shadow::History>(state_->system->fit_history());
}

}  // namespace gnomon
