#include "tests/soak/soak_world.h"

#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <vector>

#include "gnomon/components.h"
#include "systems/extract/light_facts.h"
#include "systems/lighting/kept_visibility.h"
#include "systems/shadow/maps/map_cache.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"

namespace gnomon {
namespace {

/// A kind of light with a filter.
struct Row {
    LightKind kind;
    ShadowFilter filter;
};

/// Returns all kinds with all filters. A rectangle with pcss stands for area lights: their programs take long to compile,
/// and other filters look them up as points.
std::vector<Row> soaked_rows() {
    std::vector<Row> rows;
    for (const shadow::LightKindRow& kind : shadow::light_kind_table())
        for (const shadow::FilterRow& filter : shadow::filter_table())
            if (!light_facts(kind.kind).area() ||
                (kind.kind == LightKind::rectangle && filter.id == ShadowFilter::pcss))
                rows.push_back({kind.kind, filter.id});
    return rows;
}

}  // namespace

SoakWorld::SoakWorld(std::uint64_t seed) : RandomChoice(seed) {
    world_.add_mesh(kPlane, {0, 0, 0}, false);
    camera_ = world_.add_camera({0, 6, 10}, {0, 0, 0});
}

ecs::Entity& SoakWorld::any_of(std::vector<ecs::Entity>& from) {
    return from[std::uniform_int_distribution<std::size_t>(0, from.size() - 1)(random_)];
}

void SoakWorld::add_light(LightKind kind, ShadowFilter filter) {
    constexpr std::uint32_t kLeastMap_px = 16, kSizes = 4;
    const ecs::Entity light = world_.add_light(kind, place(3.0, 8.0), "light", false);
    LightShadow shadow;
    shadow.filter = filter;
    shadow.translucent_casters = false;  // use_every_light() tries them
    shadow.resolution_px = kLeastMap_px << std::uniform_int_distribution<std::uint32_t>(0, kSizes - 1)(random_);
    world_.registry.emplace<LightShadow>(light, shadow);
    lights_.push_back(light);
}

void SoakWorld::add_caster() {
    const std::uint32_t mesh = std::uniform_int_distribution<std::uint32_t>(kBox, kMixedBox)(random_);
    casters_.push_back(world_.add_mesh(mesh, place(0.5, 4.0), true));
}

void SoakWorld::remove_one(std::vector<ecs::Entity>& from) {
    if (from.empty()) return;
    ecs::Entity& gone = any_of(from);
    world_.registry.destroy(gone);
    gone = from.back();
    from.pop_back();
}

void SoakWorld::change_light(ecs::Entity light) {
    if (!world_.registry.has<LightShadow>(light)) {
        world_.registry.emplace<LightShadow>(light, LightShadow{.translucent_casters = false});
    } else if (chance(0.5)) {
        world_.registry.remove<LightShadow>(light);
    } else {
        world_.registry.patch<LightShadow>(light, [&](LightShadow& s) { s.enabled = !s.enabled; });
    }
    if (chance(0.2))
        world_.registry.patch<Light>(light, [&](Light& l) {
            constexpr LightKind kKinds[] = {LightKind::directional, LightKind::spot, LightKind::point};
            l.kind = kKinds[std::uniform_int_distribution<std::size_t>(0, std::size(kKinds) - 1)(random_)];
        });
}

void SoakWorld::churn_lights() {
    if (lights_.size() < kMostLights && chance(0.15)) {
        const std::vector<Row> rows = soaked_rows();
        const Row row = rows[std::uniform_int_distribution<std::size_t>(0, rows.size() - 1)(random_)];
        add_light(row.kind, row.filter);
    }
    if (chance(0.1)) remove_one(lights_);
    if (lights_.empty()) return;
    if (chance(0.4)) world_.move(any_of(lights_), place(3.0, 8.0));
    if (chance(0.1)) change_light(any_of(lights_));
}

void SoakWorld::churn() {
    churn_lights();
    if (casters_.size() < kMostCasters && chance(0.3)) add_caster();
    if (chance(0.25)) remove_one(casters_);
    if (!casters_.empty() && chance(0.6)) world_.move(any_of(casters_), place(0.5, 4.0));
    if (!casters_.empty() && chance(0.05)) {
        const ecs::Entity e = any_of(casters_);
        if (world_.registry.has<ShadowCaster>(e))
            world_.registry.remove<ShadowCaster>(e);
        else
            world_.registry.emplace<ShadowCaster>(e);
    }
    if (chance(0.3)) {
        const double x = number(-4.0, 4.0), y = number(4.0, 10.0), z = number(7.0, 12.0);  // the ground stays in view
        world_.move(camera_, {x, y, z});
    }
}

void SoakWorld::use_everything(const std::function<void()>& run_frame) {
    world_.move(camera_, {0, 6, 10});
    casters_.push_back(world_.add_mesh(kSolidBox, {0, 1, 0}, true));
    casters_.push_back(world_.add_mesh(kBlendedBox, {2, 1, 0}, true));
    use_every_light(run_frame);
    casters_.push_back(world_.add_mesh(kMixedBox, {-2, 1, 0}, true));
    use_every_light(run_frame);  // rays that may meet a mask have programs of their own
}

/// Moves a caster before a map that costs more to draw than rays for all pixels.
void SoakWorld::leave_to_rays(const std::function<void()>& run_frame) {
    constexpr std::uint32_t kLarge_px = 1024;
    world_.registry.patch<LightShadow>(lights_.back(), [](LightShadow& s) { s.resolution_px = kLarge_px; });
    run_frame();
    for (const double x_m : {0.1, 0.0}) {
        world_.move(casters_.front(), {x_m, 1, 0});
        run_frame();
    }
}

/// A fit may settle in the second; then what pixels saw is kept, and read.
constexpr std::uint32_t kFramesToRest = 2 + lighting::KeptVisibility::kStaticFrames + 1;

void SoakWorld::use_every_light(const std::function<void()>& run_frame) {
    for (const Row& row : soaked_rows()) {
        add_light(row.kind, row.filter);
        // One filter by maps and one by rays: others are tinted by the same text.
        const bool by_glass = row.filter == ShadowFilter::hard || row.filter == ShadowFilter::exact;
        for (const bool tints : {by_glass, false})
            for (const std::uint32_t cascades : {1u, 4u, 0u}) {  // what fades into the next one is another program
                world_.registry.patch<LightShadow>(lights_.back(), [&](LightShadow& s) {
                    s.cascades = cascades;
                    s.translucent_casters = tints;
                });
                for (std::uint32_t i = 0; i < kFramesToRest; ++i) run_frame();
            }
        if (shadow::filter_row(row.filter).rays) leave_to_rays(run_frame);
        world_.registry.patch<LightShadow>(lights_.back(), [](LightShadow& s) { s.enabled = false; });
        run_frame();
        world_.registry.destroy(lights_.back());
        lights_.pop_back();
    }
}

void SoakWorld::clear(const std::function<void()>& run_frame) {
    while (!lights_.empty()) remove_one(lights_);
    while (!casters_.empty()) remove_one(casters_);
    world_.move(camera_, {0, 6, 10});  // emptied worlds are alike
    for (std::uint64_t i = 0; i <= shadow::MapCache::kHoldFrames; ++i) run_frame();
}

std::size_t held_bytes() {
    std::size_t all = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;  // in pages: proc(5), statm
    std::ifstream("/proc/self/statm") >> all >> resident >> shared >> text >> library >> data;
    return data * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) - mallinfo2().fordblks;
}

}  // namespace gnomon
