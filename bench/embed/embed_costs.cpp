#include "bench/embed/embed_costs.h"

#include <chrono>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <variant>

#include "bench/embed/call_clock.h"
#include "bench/embed/embed_client.h"
#include "engine/math/frustum.h"
#include "engine/math/projection.h"

namespace gnomon::bench {
namespace {

using Way = EmbedWay;

constexpr std::uint32_t kSettling = 3;     // frames until maps, programs and buffers are made
constexpr double kRounding = 1.5 / 255.0;  // a mask has 8 bits

/// Returns the part of a frame's commands that are its light passes.
gl::CommandList light_passes(const gl::CommandList& frame) {
    gl::CommandList passes;
    passes.bytes = frame.bytes;
    int depth = 0;
    for (const gl::Command& command : frame.commands) {
        const auto* begin = std::get_if<gl::BeginGroup>(&command);
        if (depth == 0 && !(begin && begin->label.text() == "lights")) continue;
        depth += begin ? 1 : std::holds_alternative<gl::EndGroup>(command) ? -1 : 0;
        passes.add(command);
    }
    return passes;
}

/// Light passes of gnomon::Frame, and an engine with gnomon::Shadows, over the same surfaces.
class Bench {
public:
    Bench(Stage& stage, const EmbedOptions& options)
        : stage_(stage), options_(options), clock_(stage.device().info().is_software) {}
    ~Bench() {
        if (engine_) engine_->free_shader(plain_shader_);
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    Result<EmbedCosts> measure();

private:
    struct Block {
        BlockTimes times;
        std::vector<double> call_us;
    };

    std::optional<Error> prepare();
    std::optional<Error> make_case(const EmbedCase& of);
    void switch_scene_lights_off();
    std::vector<PlacedLight> places() const;
    void put_lights(std::uint32_t count);
    void move_world();
    void settle(Way way);
    CallTimes call(Way way);
    CallTimes moving_call(EmbedClient& client);
    Block block(Way way);
    std::vector<float> lit_by(EmbedClient& client);
    void compare(EmbedRow& row);
    EmbedRow measure_row(std::uint32_t count);

    Stage& stage_;
    EmbedOptions options_;
    CallClock clock_;
    HostScene scene_;
    math::Aabb bounds_;
    std::unique_ptr<HostEngine> engine_;
    std::unique_ptr<EmbedClient> mask_, own_, all_;  // all_: null without whole_text
    unsigned plain_shader_ = 0;
    HostCamera camera_;
    std::vector<ecs::Entity> world_lights_;
    EmbedCase case_;
    std::uint32_t count_ = 0, turn_ = 0;
    gl::CommandList passes_;
    double whole_text_compile_s_ = 0.0;
};

void Bench::switch_scene_lights_off() {
    for (const game::NamedEntity& light : stage_.spawned().lights) {
        stage_.world().remove<LightShadow>(light.entity);
        stage_.world().remove<Light>(light.entity);
    }
}

std::optional<Error> Bench::prepare() {
    stage_.device().set_timing(gl::TimingMode::off);
    stage_.use_rays(false);  // as gnomon::Shadows, which has none
    switch_scene_lights_off();
    stage_.run_frame();
    const SceneSnapshot& scene = stage_.frame().snapshot();
    if (scene.consumers.empty()) return Error{"the scene has no camera", "", "", "scene.camera"};
    const ConsumerItem& camera = scene.consumers.front();
    if (camera.projection != CameraProjection::perspective)
        return Error{"embed wants a perspective camera", "", "", "camera.perspective"};
    bounds_ = bounds_of(scene);
    scene_ = host_scene(scene, stage_.library());
    engine_ = std::make_unique<HostEngine>(scene_, camera.viewport_px);
    const double half_y = std::tan(0.5 * camera.fov_y_rad);
    const double half_x = half_y * camera.viewport_px.x / camera.viewport_px.y;
    camera_.world_from_view = glm::dmat4(camera.rotation_ws);
    camera_.world_from_view[3] = glm::dvec4(camera.position_ws_m, 1.0);
    camera_.clip_from_view = math::reversed_perspective(-half_x, half_x, -half_y, half_y, camera.near_m, camera.far_m);
    const auto plain = engine_->make_shader(HostShadows::none);
    if (!plain) return plain.error();
    plain_shader_ = plain.value();
    mask_ = std::make_unique<EmbedClient>(*engine_, HostShadows::mask);
    if (auto error = mask_->make(scene_)) return error;
    if (!options_.whole_text) return std::nullopt;
    all_ = std::make_unique<EmbedClient>(*engine_, HostShadows::lookup);
    const auto start = std::chrono::steady_clock::now();
    if (auto error = all_->make(scene_)) return error;
    whole_text_compile_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::nullopt;
}

std::vector<PlacedLight> Bench::places() const {
    std::vector<PlacedLight> lights;
    for (std::uint32_t i = 0; i < count_; ++i) lights.push_back(placed_light(case_, i, turn_, bounds_));
    return lights;
}

/// Replaces the lights of all that takes part.
void Bench::put_lights(std::uint32_t count) {
    count_ = count;
    const std::vector<PlacedLight> lights = places();
    ecs::Registry& world = stage_.world();
    for (const ecs::Entity light : world_lights_) world.destroy(light);
    world_lights_.clear();
    for (const PlacedLight& place : lights) {
        const ecs::Entity light = world_lights_.emplace_back(world.create());
        world.emplace<Transform>(light, {});
        world.emplace<Light>(light, place.light);
        world.emplace<LightShadow>(light, place.shadow);
        world.emplace<ShadowTuning>(light, place.tuning);
    }
    move_world();
    for (EmbedClient* client : {mask_.get(), own_.get(), all_.get()})
        if (client) client->put_lights(lights);
}

void Bench::move_world() {
    const std::vector<PlacedLight> lights = places();
    for (std::size_t i = 0; i < lights.size(); ++i)
        stage_.world().patch<Transform>(world_lights_[i], [&](Transform& t) {
            t.translation_m = lights[i].position_m;
            t.rotation = glm::quat_cast(math::basis_from_back(-lights[i].direction));
        });
}

/// Brings what a still way reads to rest.
void Bench::settle(Way way) {
    const bool is_frame = way == Way::passes || way == Way::passes_without;
    EmbedClient* client = way == Way::mask         ? mask_.get()
                          : way == Way::lookup     ? own_.get()
                          : way == Way::lookup_all ? all_.get()
                                                   : nullptr;
    if (is_frame) stage_.show_shadows(way == Way::passes);
    for (std::uint32_t i = 0; i < kSettling; ++i) {
        if (is_frame) stage_.run_frame();
        if (client) client->render(camera_);
    }
    if (is_frame) passes_ = light_passes(stage_.frame().commands());
}

/// Times an engine's frame after all lights have moved.
CallTimes Bench::moving_call(EmbedClient& client) {
    const auto move = [&] {
        ++turn_;
        client.move_lights(places());
    };
    return clock_.time(move, [&] {
        engine_->draw_surfaces(camera_);
        client.render(camera_);
        client.light(camera_);
    });
}

CallTimes Bench::call(Way way) {
    const auto nothing = [] {};
    switch (way) {
        case Way::passes_without:
        case Way::passes:
            return clock_.time(nothing, [&] { stage_.device().submit(passes_); });
        case Way::mask:
            return clock_.time(nothing, [&] { mask_->render(camera_); });
        case Way::shader_without:
            return clock_.time(
                nothing, [&] { engine_->draw_lights(plain_shader_, camera_, host_lights(places(), camera_), 0); });
        case Way::lookup:
            return clock_.time(nothing, [&] { own_->light(camera_); });
        case Way::lookup_all:
            return clock_.time(nothing, [&] { all_->light(camera_); });
        case Way::moving_frame:
            return clock_.time(
                [&] {
                    ++turn_;
                    move_world();
                },
                [&] { stage_.run_frame(); });
        case Way::moving_mask:
            return moving_call(*mask_);
        case Way::moving_lookup:
            return moving_call(*own_);
        case Way::count:
            break;
    }
    return {};
}

Bench::Block Bench::block(Way way) {
    const bool moves = way >= Way::moving_frame;
    if (!moves) settle(way);
    Block block;
    const std::uint32_t first = moves ? kSettling : 1;
    for (std::uint32_t i = 0; i < first + options_.frames; ++i) {
        const CallTimes times = call(way);
        if (i < first) continue;
        block.times.us.push_back(times.us);
        block.times.cpu_us.push_back(times.cpu_us);
        block.call_us.push_back(times.call_us);
    }
    return block;
}

std::vector<float> Bench::lit_by(EmbedClient& client) {
    client.render(camera_);
    client.light(camera_);
    return engine_->read_lit();
}

/// Compares what mask and lookups show, and both with the same surfaces without shadows.
void Bench::compare(EmbedRow& row) {
    const std::vector<float> mask = lit_by(*mask_), lookup = lit_by(*own_);
    engine_->draw_lights(plain_shader_, camera_, host_lights(places(), camera_), 0);
    const std::vector<float> plain = engine_->read_lit();
    const auto differ = [&](float a, float b) { return static_cast<double>(std::abs(a - b)) > kRounding * row.lights; };
    std::size_t lit = 0, shadowed = 0, differing = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (!(plain[i] > 0.0f)) continue;
        ++lit;
        shadowed += differ(plain[i], mask[i]);
        differing += differ(mask[i], lookup[i]);
    }
    if (lit == 0) return;
    row.shadowed = static_cast<double>(shadowed) / static_cast<double>(lit);
    row.differs = static_cast<double>(differing) / static_cast<double>(lit);
}

EmbedRow Bench::measure_row(std::uint32_t count) {
    EmbedRow row;
    row.kind = case_.kind_name;
    row.filter = filter_name(case_.filter);
    row.lights = count;
    put_lights(count);
    engine_->draw_surfaces(camera_);
    compare(row);
    for (std::uint32_t i = 0; i < count; ++i) {
        const LightStatus status = mask_->status(i);
        row.maps += status.maps;
        row.used_filter = status.maps == 0 ? "none" : filter_name(status.filter);
    }
    std::array<TimedRounds, kEmbedWays> rounds;
    std::array<std::vector<double>, kEmbedWays> call_us;
    for (std::uint32_t round = 0; round < options_.rounds; ++round) {
        std::array<TimedRounds::Medians, kEmbedWays> medians{};
        for (std::size_t w = 0; w < kEmbedWays; ++w) {
            const auto way = static_cast<Way>(w);
            if (way == Way::lookup_all && !all_) continue;
            const Block timed = block(way);
            const Way base = info_of(way).base;
            medians[w] =
                rounds[w].add(timed.times, base == Way::count ? nullptr : &medians[static_cast<std::size_t>(base)]);
            call_us[w].insert(call_us[w].end(), timed.call_us.begin(), timed.call_us.end());
        }
    }
    for (std::size_t w = 0; w < kEmbedWays; ++w) row.ways[w] = {rounds[w].frames(), spread_of(call_us[w])};
    return row;
}

/// Makes the client for lights of one kind. Its text has only the filter that their maps are read with.
std::optional<Error> Bench::make_case(const EmbedCase& of) {
    own_.reset();
    case_ = of;
    put_lights(1);
    mask_->render(camera_);
    EmbedCase used = of;
    used.filter = mask_->status(0).filter;
    own_ = std::make_unique<EmbedClient>(*engine_, HostShadows::lookup);
    return own_->make(scene_, used);
}

Result<EmbedCosts> Bench::measure() {
    EmbedCosts costs;
    costs.scene = stage_.scene_name();
    costs.device = stage_.device().info().name;
    costs.is_software = stage_.device().info().is_software;
    costs.method = clock_.method();
    if (auto error = prepare()) return *error;
    costs.size_px = engine_->size_px();
    costs.whole_text_compile_s = whole_text_compile_s_;
    game::LightSettings settings;
    for (const std::string& setting : options_.settings)
        if (auto error = game::apply_setting(settings, setting)) return *error;
    for (EmbedCase of : embed_cases(options_.quick)) {
        if (of.name().find(options_.only) == std::string::npos) continue;
        of.settings = settings;
        if (auto error = make_case(of)) return *error;
        for (const std::uint32_t count : options_.lights) costs.rows.push_back(measure_row(count));
    }
    costs.starved = clock_.starved();
    if (costs.rows.empty()) return Error{"--only names no lights: as 'spots default'", "", "", "bench.only"};
    return costs;
}

}  // namespace

Result<EmbedCosts> measure_embed(Stage& stage, const EmbedOptions& options) { return Bench(stage, options).measure(); }

}  // namespace gnomon::bench
