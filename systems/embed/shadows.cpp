#include "gnomon/shadows.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>
#include <vector>

#include "engine/core/workers.h"
#include "engine/core/zone.h"
#include "engine/gl/device_gl45.h"
#include "systems/after_submission.h"
#include "systems/embed/draw_drawables.h"
#include "systems/embed/engine_meshes.h"
#include "systems/embed/picture_lens.h"
#include "systems/embed/scene_store.h"
#include "systems/embed/view_group.h"
#include "systems/embed/view_state.h"
#include "systems/lighting/light_programs.h"
#include "systems/lighting/mask_pass.h"
#include "systems/lookup/lookup_glsl.h"
#include "systems/lookup/lookup_table.h"
#include "systems/visibility/caster_trees.h"
#include "systems/visibility/light_queries.h"

namespace gnomon {
namespace {

using embed::ViewGroup;
using embed::ViewState;

lookup::LookupBindings bindings_of(const LookupOptions& options) {
    return {options.first_texture_unit, options.texture_unit_count, options.storage_binding};
}

lookup::LookupRows rows_of(const LookupOptions& options, const gl::DeviceInfo& device) {
    return {.filters = options.filters.empty() ? lookup::usual_filters() : std::span(options.filters),
            .suns = options.suns,
            .warped_suns = options.suns,
            .cones = options.spots,
            .cubes = options.points,
            .masks = options.alpha_tests,
            .antialias = options.antialias,
            .for_hardware = !device.is_software};
}

ecs::Entity entity_of(std::size_t view) { return {static_cast<std::uint32_t>(view), 1}; }

std::string_view code(gl::Failure failure) { return failure == gl::Failure::none ? "" : gl::to_text(failure); }

}  // namespace

struct Shadows::State {
    State(std::unique_ptr<gl::Device> gl_device, std::unique_ptr<embed::SceneStore> scene, GpuScene on_device,
          const ShadowsOptions& wanted)
        : options(wanted),
          device(std::move(gl_device)),
          store_owner(std::move(scene)),
          store(*store_owner),
          programs(*device),
          gpu(std::move(on_device)),
          engine_meshes(*device),
          workers(options.threads),
          groups(*device, &workers, options.lookup.has_value()),
          trees(store.library()),
          queries(trees) {
        set_timing();
    }
    ~State() {
        for (const auto& view : views) {
            device->destroy(view->depth.handle);
            device->destroy(view->normals.handle);
        }
    }
    /// Times the device's work where budget or options need it.
    void set_timing() {
        using Mode = gl::TimingMode;
        device->set_timing(!wants_times() ? Mode::off : device->info().is_software ? Mode::finish : Mode::query);
    }
    bool wants_times() const { return options.time_gpu || learns_costs(); }
    bool learns_costs() const { return options.budget.gpu_ms > 0.0f; }

    void take_view(const View& view, std::size_t index);
    void list_layers(const View& view, ViewState& state) const;
    void record_masks(ViewGroup& group);
    void record_lookups(const ViewGroup& group);
    void run(ViewGroup& group);
    void sum_up();
    void fill_masks(std::size_t count);

    ShadowsOptions options;
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<embed::SceneStore> store_owner;  // its library stays where it is
    embed::SceneStore& store;
    lighting::LightPrograms programs;
    GpuScene gpu;
    embed::EngineMeshes engine_meshes;
    Workers workers;
    embed::ViewGroups groups;
    std::vector<std::unique_ptr<ViewState>> views;
    std::vector<ConsumerItem> consumers;
    std::vector<std::uint32_t> consumer_views;       // view of each consumer
    std::vector<embed::ViewLayers> consumer_layers;  // and its layers
    std::vector<Mask> masks;
    gl::CommandList commands, begun;
    std::vector<gl::EngineBinding> bindings;
    RenderStatus status;
    visibility::CasterTrees trees;
    visibility::LightQueries queries;
};

/// Takes one view's camera and textures. A view that cannot be read has a failure, and is no consumer.
void Shadows::State::take_view(const View& view, std::size_t index) {
    ViewState& state = *views[index];
    state.failure = {};
    if (view.size_px.x == 0 || view.size_px.y == 0 || view.size_px.x > device->info().max_texture_px ||
        view.size_px.y > device->info().max_texture_px) {
        state.failure = "view.size";
        return;
    }
    std::optional<lighting::PictureLens> lens = embed::lens_of(view.clip_from_view, view.clip_depth);
    ConsumerItem consumer;
    consumer.entity = entity_of(index);
    if (lens) embed::update_reach(*lens, view.size_px, state.reach);
    if (!lens || !embed::put_view(view.world_from_view, state.reach, *lens, consumer)) {
        state.failure = "view.projection";
        return;
    }
    state.picture.size_px = view.size_px;
    state.picture.lens = *lens;
    state.picture.shows_only_added = view.shows_only_added;
    consumers.push_back(consumer);
    consumer_views.push_back(static_cast<std::uint32_t>(index));
    consumer_layers.push_back({view.cast_layers, view.receive_layers});
    state.wants_mask = view.wants_mask;
    state.noise_frame = view.noise_frame;
    if (!view.wants_mask) return;
    state.failure = embed::take_textures(*device, view, state);
    if (state.failure.empty()) return;
    consumers.pop_back();
    consumer_views.pop_back();
    consumer_layers.pop_back();
}

/// Lists the light of each layer of a view's mask, as an index of the updated snapshot. A mask with more layers than
/// the device's textures have is a failure of that view.
void Shadows::State::list_layers(const View& view, ViewState& state) const {
    state.layers.clear();
    for (const LightId light : view.lights) state.layers.push_back(store.light_index(light));
    if (view.lights.empty())
        for (std::uint32_t i = 0; i < store.snapshot().lights.size(); ++i) state.layers.push_back(i);
    const std::size_t samples = std::max<std::size_t>(state.picture.samples.size(), 1);
    if (state.failure.empty() && state.wants_mask && state.layers.size() * samples > device->info().max_layers)
        state.failure = "view.lights";
}

/// Records the mask of each view of a group.
void Shadows::State::record_masks(ViewGroup& group) {
    const shadow::ShadowFrame& frame = group.shadows.frame();
    gl::Failure worst = gl::Failure::none;
    for (std::size_t c = 0; c < group.views.size() && c < frame.inputs.size(); ++c) {
        ViewState& view = *views[group.views[c]];
        if (!view.wants_mask || !view.failure.empty()) continue;
        view.mask.record({frame.inputs[c], group.scene(), gpu, view.picture, view.layers, view.noise_frame}, commands,
                         group.outcome);
        view.failure = code(group.outcome.failure);
        if (group.outcome.failure != gl::Failure::none) worst = group.outcome.failure;
    }
    group.outcome.failure = worst;
}

/// Records what the text for all lights reads, for each view of a group.
void Shadows::State::record_lookups(const ViewGroup& group) {
    if (!options.lookup) return;
    const shadow::ShadowFrame& frame = group.shadows.frame();
    for (std::size_t c = 0; c < group.views.size() && c < frame.inputs.size(); ++c) {
        ViewState& view = *views[group.views[c]];
        if (!view.table)
            view.table = std::make_unique<lookup::LookupTable>(*device, bindings_of(*options.lookup),
                                                               rows_of(*options.lookup, device->info()));
        view.has_table = view.table->update(frame.inputs[c], gpu, commands, view.noise_frame);
    }
}

/// Runs a group: its maps, masks and lookups, after the commands recorded before.
void Shadows::State::run(ViewGroup& group) {
    const SceneSnapshot& scene = group.scene();
    const auto share = static_cast<std::uint32_t>(groups.active().size());  // each group has an equal share
    const shadow::ShadowSettings settings{
        .budget = {options.budget.bytes == 0 ? shadow::ShadowBudget::kUnlimited
                                             : std::max<std::uint64_t>(options.budget.bytes / share, 1),
                   options.budget.gpu_ms / static_cast<float>(share)},
        .rays = false};
    group.report.clear();
    group.outcome.clear();
    group.shadows.update(scene, gpu, settings, commands, group.report);
    record_masks(group);
    record_lookups(group);
    group.shadows.report(scene, group.outcome, group.report);
    const gl::Failure begun_failure = embed::draw_drawables(*device, store, group, begun);
    gl::SubmitResult result = device->submit(commands);
    if (result.failure == gl::Failure::none) result.failure = begun_failure;
    commands.clear();
    group.timed.submitted(result.submission, group.report);
    commit_submission({*device, scene, gpu, group.shadows}, result, learns_costs(), group.report);
    if (result.failure == gl::Failure::none) return;
    status.failure = code(result.failure);
    for (const std::uint32_t view : group.views) {
        views[view]->has_table = false;
        if (views[view]->table) views[view]->table->forget_upload();
    }
}

/// Hands out the times that arrived, and sums up what all groups did.
void Shadows::State::sum_up() {
    const std::vector<gl::Timing> timings = device->take_timings();
    status.still = true;
    for (ViewGroup* group : groups.active()) {
        learn_times({*device, group->scene(), gpu, group->shadows}, timings, learns_costs());
        group->timed.tell(timings, group->report);
        if (group->report.gpu_us) group->gpu_us = group->report.gpu_us;
        if (group->gpu_us) status.gpu_us = status.gpu_us.value_or(0.0) + *group->gpu_us;
        status.still = status.still && group->report.still;
        for (const LightReport& light : group->report.lights) {
            status.maps_drawn += light.counts.views_drawn;
            status.draws += light.counts.draws;
            status.bytes += light.counts.bytes;
        }
    }
}

void Shadows::State::fill_masks(std::size_t count) {
    masks.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
        ViewState& view = *views[i];
        masks[i].failure = !view.failure.empty() ? view.failure : status.failure;
        if (!masks[i].failure.empty() || !view.wants_mask || view.layers.empty()) continue;
        masks[i].texture = gl::gl_name(*device, view.mask.texture());
        masks[i].tint_texture = gl::gl_name(*device, view.mask.tint_texture());
        masks[i].layers = view.mask.layer_count();
        masks[i].samples = static_cast<std::uint32_t>(std::max<std::size_t>(view.picture.samples.size(), 1));
    }
}

Result<std::unique_ptr<Shadows>> Shadows::create(const ShadowsOptions& options) {
    gl::MessageSink sink;
    if (options.message)
        sink = [message = options.message](gl::MessageSeverity severity, std::string_view text) {
            if (severity >= gl::MessageSeverity::medium) message(text);
        };
    auto device = gl::make_gl45_device(std::move(sink), {.keeps_state = true});
    if (!device) return device.error();
    auto store = std::make_unique<embed::SceneStore>();
    auto scene = GpuScene::create(*device.value(), store->library());
    if (!scene) return scene.error();
    return std::unique_ptr<Shadows>(new Shadows(
        std::make_unique<State>(std::move(device).value(), std::move(store), std::move(scene).value(), options)));
}

Shadows::Shadows(std::unique_ptr<State> state) : state_(std::move(state)) {}
Shadows::~Shadows() = default;

Result<MeshId> Shadows::add_mesh(const MeshDesc& mesh) { return state_->store.add_mesh(mesh); }
Result<MeshId> Shadows::add_buffer_mesh(const BufferMeshDesc& mesh) {
    State& s = *state_;
    const auto made = s.engine_meshes.import(mesh);
    if (!made) return made.error();
    const MeshId id = s.store.add_box(mesh.name, mesh.bounds);
    s.engine_meshes.keep(s.store.mesh_index(id));
    s.gpu.put_engine_mesh(s.store.mesh_index(id), made.value());
    return id;
}
void Shadows::mesh_changed(MeshId mesh, const Bounds& bounds) { state_->store.change_box(mesh, bounds); }
void Shadows::remove(MeshId mesh) {
    State& s = *state_;
    const std::uint32_t index = s.store.mesh_index(mesh);
    s.store.remove(mesh);
    if (s.engine_meshes.remove(index)) s.gpu.put_engine_mesh(index, {});
}
CasterId Shadows::add_drawable(const DrawableDesc& drawable) { return state_->store.add_drawable(drawable); }
void Shadows::redraw(CasterId drawable, const Bounds& bounds, double moves_at_most_m) {
    state_->store.redraw(drawable, bounds, moves_at_most_m);
}
CasterId Shadows::add_caster(const CasterDesc& caster) { return state_->store.add_caster(caster); }
void Shadows::set_transform(CasterId caster, const glm::dmat4& world_from_mesh) {
    state_->store.set_transform(caster, world_from_mesh);
}
void Shadows::set_caster(CasterId caster, const CasterDesc& desc) { state_->store.set_caster(caster, desc); }
void Shadows::remove(CasterId caster) { state_->store.remove(caster); }
CasterId Shadows::add_air(const AirDesc& air) { return state_->store.add_air(air); }
void Shadows::set_air(CasterId air, const AirDesc& desc) { state_->store.set_air(air, desc); }
LightId Shadows::add_light(const LightDesc& light) { return state_->store.add_light(light); }
void Shadows::set_light(LightId light, const LightDesc& desc) { state_->store.set_light(light, desc); }
void Shadows::tune(LightId light, const ShadowTuning& tuning) { state_->store.tune(light, tuning); }
void Shadows::remove(LightId light) { state_->store.remove(light); }

void Shadows::set_budget(const Budget& budget) {
    state_->options.budget = budget;
    state_->set_timing();
}

std::span<const Mask> Shadows::render(std::span<const View> views) {
    GNOMON_ZONE("gnomon::Shadows::render");
    const auto start = std::chrono::steady_clock::now();
    State& s = *state_;
    s.commands.clear();
    s.status = {};
    if (!gl::is_current(*s.device)) {
        s.status.failure = "context.other";
        s.masks.assign(views.size(), {.failure = s.status.failure});
        return s.masks;
    }
    s.consumers.clear();
    s.consumer_views.clear();
    s.consumer_layers.clear();
    while (s.views.size() < views.size()) s.views.push_back(std::make_unique<ViewState>(*s.device, s.programs));
    s.programs.next_frame();
    for (const auto& view : s.views) view->has_table = false;
    for (std::size_t i = 0; i < views.size(); ++i) s.take_view(views[i], i);
    s.gpu.update_meshes(s.commands);
    s.store.update(s.consumers, s.gpu.lacking_meshes(), s.engine_meshes.lost());
    for (std::size_t i = 0; i < views.size(); ++i) s.list_layers(views[i], *s.views[i]);
    const SceneSnapshot& scene = s.store.snapshot();
    if (!s.gpu.update(scene, s.commands)) s.status.failure = "instances_full";
    const bool keeps_idle = s.options.budget.bytes == 0;  // idle groups have no part in a budget
    s.groups.arrange(scene, s.consumer_views, s.consumer_layers, keeps_idle);
    for (ViewGroup* group : s.groups.active()) s.run(*group);
    s.sum_up();
    s.fill_masks(views.size());
    s.status.cpu_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    return s.masks;
}

Result<std::string> Shadows::lookup_glsl() const {
    const std::optional<LookupOptions>& options = state_->options.lookup;
    if (!options) return Error{"ShadowsOptions::lookup is empty: maps are not shared", {}, {}, "lookup.off"};
    return lookup::lookup_glsl(bindings_of(*options), rows_of(*options, state_->device->info()));
}

bool Shadows::bind_lookup(std::size_t view) {
    State& s = *state_;
    if (view >= s.views.size() || !s.views[view]->has_table) return false;
    const lookup::LookupTable& table = *s.views[view]->table;
    using Kind = gl::EngineBinding::Kind;
    s.bindings.clear();
    for (const lookup::LookupTexture& t : table.textures())
        s.bindings.push_back({Kind::texture, t.unit, t.texture, t.sampler, {}});
    for (const lookup::LookupTexels& t : table.texels()) s.bindings.push_back({Kind::texels, t.unit, {}, {}, t.buffer});
    for (const lookup::LookupStorage& t : table.storage())
        s.bindings.push_back({Kind::storage, t.binding, {}, {}, t.buffer});
    gl::bind_for_engine(*s.device, s.bindings);
    return true;
}

int Shadows::lookup_index(LightId light) const {
    const std::uint32_t index = state_->store.light_index(light);
    return index == embed::SceneStore::kNone ? -1 : static_cast<int>(index);
}

std::string_view Shadows::lookup_status(LightId light, std::size_t view) const {
    const State& s = *state_;
    const std::uint32_t index = s.store.light_index(light);
    if (view >= s.views.size() || !s.views[view]->has_table || index >= s.views[view]->table->outcomes().size())
        return "no lookup";
    return lookup::to_text(s.views[view]->table->outcomes()[index].status);
}

LightStatus Shadows::status(LightId light) const { return state_->groups.status(state_->store.light_index(light)); }

const RenderStatus& Shadows::status() const { return state_->status; }
std::span<const Dropped> Shadows::dropped() const { return state_->store.dropped(); }

float Shadows::visibility(LightId light, const glm::dvec3& position_m, double radius_m) {
    State& s = *state_;
    const std::uint32_t index = s.store.light_index(light);
    if (index >= s.store.snapshot().lights.size()) return 0.0f;
    const visibility::Place place{position_m, radius_m};
    float answer = 0.0f;
    s.queries.ask(s.store.snapshot(), s.store.snapshot().lights[index], {&place, 1}, {}, {&answer, 1});
    return answer;
}

}  // namespace gnomon
