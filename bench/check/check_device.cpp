#include "bench/check/check_device.h"

#include <cinttypes>

#include "bench/text/printf_string.h"
#include "systems/shadow/update/cube_layering.h"

namespace gnomon::bench {
namespace {

constexpr double kMiB = 1024.0 * 1024.0;
constexpr std::uint64_t kInstanceBytes = 64;  // size of a record that shaders read as texels
constexpr std::uint32_t kFaces = 6;

const char* route_words(CubeRoute route) {
    return route == CubeRoute::layered_vertex     ? "one pass, layers by the vertex stage"
           : route == CubeRoute::layered_geometry ? "one pass, layers by the geometry stage"
                                                  : "six passes";
}

std::vector<std::string> what_follows(const gl::DeviceFacts& facts, const gl::DeviceInfo& info) {
    std::vector<std::string> all;
    all.push_back(info.is_software ? "software device: times are taken by finishing around each pass"
                                   : "hardware device: times are taken by timer queries");
    all.push_back(
        formatted("maps: at most %u px flat, %u px a cube's face; "
                  "larger requests are cut to that",
                  info.max_texture_px, info.max_cube_px));
    all.push_back(formatted("cube faces by cube_route=automatic: %s",
                            route_words(shadow::cube_route(CubeRoute::automatic, info, kFaces))));
    all.push_back(formatted("cube_route=layered_vertex: %s",
                            route_words(shadow::cube_route(CubeRoute::layered_vertex, info, kFaces))));
    all.push_back(formatted("instances are read as texels: %.0f MiB, %" PRIu64 " of them",
                            static_cast<double>(info.max_texel_bytes) / kMiB, info.max_texel_bytes / kInstanceBytes));
    all.push_back(formatted("records of views and lights lie %u bytes apart at least", info.uniform_alignment));
    all.push_back(info.max_point_px > 1
                      ? formatted("small triangles of exact maps: points up to %u px", info.max_point_px)
                      : std::string("small triangles of exact maps: drawn as the large ones are"));
    all.push_back(facts.robust ? "a lost context is noticed, and reported as such"
                               : "a lost context is not noticed: the driver has "
                                 "no reset notification");
    return all;
}

}  // namespace

DeviceCheck check_device(gl::DeviceFacts facts, const gl::DeviceInfo& info) {
    DeviceCheck check{std::move(facts), info, {}, {}};
    check.follow = what_follows(check.facts, info);
    for (const gl::DeviceLimit& limit : check.facts.limits)
        if (!limit.serves())
            check.short_of.push_back(formatted("%s is %" PRId64 ", %s %" PRId64, limit.name, limit.value,
                                               limit.is_ceiling ? "at most" : "at least", limit.needed));
    return check;
}

}  // namespace gnomon::bench
