#include "tests/oracle/traced_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "tests/oracle/alpha_mask.h"
#include "tests/oracle/posed_positions.h"

namespace gnomon::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFloatUnit = 1.0 / (1 << 24);          // relative rounding error of float
constexpr double kDoubleUnit = 1.1102230246251565e-16;  // 2^-53

// A float ray differs from its double one by at most u|o| + u|td| <= 3uR within the scene. Embree's slab test adds
// about 3 roundings of (|o| + |box|) per plane, <= 6uR. Boxes wider by 32uR lose nothing.
constexpr double kPaddingUnits = 32.0;
// P = o + t*d and dot(n, P - a) round a dozen times on numbers no larger than the world's coordinates.
constexpr double kPlaneUnits = 64.0;
// t as float, made larger by more than its rounding.
constexpr float kFarSlack = 1.0f + 1.0f / (1 << 20);

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

float upward(double value) { return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()); }
float downward(double value) { return -upward(-value); }

// Embree hands the context of a query to its callbacks; the question travels behind it.
struct Query {
    QueryContext context{};
    const ExactRay* ray = nullptr;
    double t_min = 0.0, t_max = kInfinity;
    ShadowLayers layers = 0;
    std::uint32_t start_triangle = kNoTriangle;
    bool farthest = false;  // take the occluder of the largest t, not any
    SurfaceHit best;
};

Query make_query(const ExactRay& ray, double t_min, double t_max) {
    Query query;
    init_query(query.context);
    query.ray = &ray;
    query.t_min = t_min;
    query.t_max = t_max;
    return query;
}

Query query_of_occluders(const ExactRay& ray, double t_max, std::uint32_t start_triangle, ShadowLayers layers) {
    Query query = make_query(ray, 0.0, t_max);
    query.layers = layers;
    query.start_triangle = start_triangle;
    return query;
}

RTCRay to_embree(const ExactRay& ray, double t_max) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin.x);
    r.org_y = static_cast<float>(ray.origin.y);
    r.org_z = static_cast<float>(ray.origin.z);
    r.dir_x = static_cast<float>(ray.direction.x);
    r.dir_y = static_cast<float>(ray.direction.y);
    r.dir_z = static_cast<float>(ray.direction.z);
    r.tnear = 0.0f;
    r.tfar = static_cast<float>(t_max) * kFarSlack;
    r.mask = ~0u;
    return r;
}

}  // namespace

TracedWorld::TracedWorld(const SceneSnapshot& snapshot, const assets::MeshLibrary& library,
                         const glm::dvec3& origin_ws_m)
    : library_(library), origin_ws_m_(origin_ws_m) {
    std::map<std::uint32_t, std::vector<glm::dvec3>> positions;  // by mesh
    for (std::size_t i = 0; i < snapshot.instances.size(); ++i) {
        const InstanceItem& item = snapshot.instances[i];
        if (item.mesh >= library_.meshes.size() || !(shows_surface(item) || item.casts)) continue;
        const auto [of_mesh, is_new] = positions.try_emplace(item.mesh);
        if (is_new) of_mesh->second = posed_positions(snapshot, library, item.mesh);
        add_instance(item, static_cast<std::uint32_t>(i), of_mesh->second);
    }

    double radius_m = 0.0;
    for (const WorldTriangle& t : triangles_) radius_m = std::max({radius_m, largest(t.a), largest(t.b), largest(t.c)});
    plane_error_m_ = kPlaneUnits * kDoubleUnit * (radius_m + largest(origin_ws_m));
    for (const ConsumerItem& consumer : snapshot.consumers)
        radius_m = std::max(radius_m, largest(consumer.position_ws_m - origin_ws_m));
    padding_m_ = kPaddingUnits * kFloatUnit * radius_m;

    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles_.size()));
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, bounds_callback, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_callback);
    rtcSetGeometryOccludedFunction(geometry, occluded_callback);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
}

TracedWorld::~TracedWorld() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void TracedWorld::add_instance(const InstanceItem& item, std::uint32_t index,
                               const std::vector<glm::dvec3>& positions) {
    const assets::Mesh& mesh = library_.meshes[item.mesh];
    const glm::dvec3 translation = item.translation_ws_m - origin_ws_m_;
    const auto place = [&](std::uint32_t i) { return item.basis * positions[mesh.indices[i]] + translation; };
    for (const assets::Submesh& submesh : mesh.submeshes) {
        const assets::Material& material = library_.materials[submesh.material];
        if (material.alpha_mode == assets::AlphaMode::blend) continue;
        for (std::uint32_t i = 0; i + 2 < submesh.index_count; i += 3) {
            WorldTriangle t;
            t.first_index = submesh.first_index + i;
            t.a = place(t.first_index);
            t.b = place(t.first_index + 1);
            t.c = place(t.first_index + 2);
            t.instance = index;
            t.mesh = item.mesh;
            t.material = submesh.material;
            t.visible = shows_surface(item);
            t.cast_layers = item.casts && !assets::transmits(material) ? item.cast_layers : ShadowLayers{0};
            t.receive_layers = item.receives ? item.receive_layers : ShadowLayers{0};
            t.mirrored = item.winding.mirrored;
            t.double_sided = material.double_sided || item.winding.folded;
            t.masked = material.alpha_mode == assets::AlphaMode::mask;
            const glm::dvec3 n = front_normal(t);
            if (is_finite(t.a) && is_finite(n) && glm::dot(n, n) > 0.0) triangles_.push_back(t);
        }
    }
}

bool TracedWorld::is_there(const WorldTriangle& triangle, const ExactHit& hit) const {
    if (!triangle.masked) return true;
    const assets::Mesh& mesh = library_.meshes[triangle.mesh];
    const auto uv = [&](std::uint32_t corner) {
        return glm::dvec2(mesh.vertices[mesh.indices[triangle.first_index + corner]].uv);
    };
    double vertex_alpha = 1.0;
    if (!mesh.colours.empty()) {
        const auto alpha = [&](std::uint32_t corner) {
            return static_cast<double>(mesh.colours[mesh.indices[triangle.first_index + corner]].w);
        };
        vertex_alpha = hit.u * alpha(0) + hit.v * alpha(1) + hit.w * alpha(2);
    }
    return passes_mask(library_, library_.materials[triangle.material], hit.u * uv(0) + hit.v * uv(1) + hit.w * uv(2),
                       vertex_alpha);
}

bool TracedWorld::on_plane(const glm::dvec3& point, std::uint32_t triangle) const {
    const WorldTriangle& t = triangles_[triangle];
    const glm::dvec3 n = front_normal(t);
    return std::abs(glm::dot(n, point - t.a)) <= plane_error_m_ * glm::length(n);
}

bool TracedWorld::blocks(const ExactRay& ray, double t_max, ShadowLayers layers, std::uint32_t start_triangle,
                         std::uint32_t triangle, double& t_hit) const {
    const WorldTriangle& t = triangles_[triangle];
    ExactHit hit;
    if (triangle == start_triangle || (t.cast_layers & layers) == 0 || !intersect(ray, t.a, t.b, t.c, hit))
        return false;
    if (!(hit.t > 0.0) || on_plane(ray.origin, triangle)) return false;
    const glm::dvec3 end = ray.origin + t_max * ray.direction;
    const bool ends_on_plane = is_finite(end) && on_plane(end, triangle);
    const bool between = ends_on_plane ? glm::dot(front_normal(t), ray.origin - t.a) < 0.0 : hit.t < t_max;
    t_hit = hit.t;
    return between && is_there(t, hit);
}

bool TracedWorld::shows(const ExactRay& ray, double t_min, double t_max, std::uint32_t triangle, double& t_hit) const {
    const WorldTriangle& t = triangles_[triangle];
    ExactHit hit;
    if (!t.visible || !intersect(ray, t.a, t.b, t.c, hit)) return false;
    if (!(hit.t >= t_min && hit.t <= t_max)) return false;
    if (!t.double_sided && !(glm::dot(front_normal(t), ray.direction) < 0.0)) return false;
    t_hit = hit.t;
    return is_there(t, hit);
}

SurfaceHit TracedWorld::nearest_surface(const ExactRay& ray, double t_min, double t_max) const {
    Query query = make_query(ray, t_min, t_max);
    RTCRayHit r{};
    r.ray = to_embree(ray, t_max);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene_, query.context, r);
    return query.best;
}

std::uint32_t TracedWorld::occluder(const ExactRay& ray, double t_max, std::uint32_t start_triangle, std::uint32_t hint,
                                    ShadowLayers layers) const {
    double t = 0.0;
    if (hint != kNoTriangle && blocks(ray, t_max, layers, start_triangle, hint, t)) return hint;
    Query query = query_of_occluders(ray, t_max, start_triangle, layers);
    RTCRay r = to_embree(ray, t_max);
    occlude(scene_, query.context, r);
    return query.best.triangle;
}

std::uint32_t TracedWorld::farthest_occluder(const ExactRay& ray, double t_max, std::uint32_t start_triangle,
                                             ShadowLayers layers) const {
    Query query = query_of_occluders(ray, t_max, start_triangle, layers);
    query.farthest = true;
    RTCRay r = to_embree(ray, t_max);
    occlude(scene_, query.context, r);
    return query.best.triangle;
}

void TracedWorld::bounds_callback(const RTCBoundsFunctionArguments* args) {
    const auto& world = *static_cast<const TracedWorld*>(args->geometryUserPtr);
    const WorldTriangle& t = world.triangles_[args->primID];
    const glm::dvec3 low = glm::min(glm::min(t.a, t.b), t.c) - world.padding_m_;
    const glm::dvec3 high = glm::max(glm::max(t.a, t.b), t.c) + world.padding_m_;
    RTCBounds& bounds = *args->bounds_o;
    bounds.lower_x = downward(low.x);
    bounds.lower_y = downward(low.y);
    bounds.lower_z = downward(low.z);
    bounds.upper_x = upward(high.x);
    bounds.upper_y = upward(high.y);
    bounds.upper_z = upward(high.z);
}

void TracedWorld::intersect_callback(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto& world = *static_cast<const TracedWorld*>(args->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(args->context);
    double t = 0.0;
    if (!world.shows(*query.ray, query.t_min, query.t_max, args->primID, t)) return;
    const bool nearer = query.best.triangle == kNoTriangle || t < query.best.t ||
                        (t <= query.best.t && args->primID < query.best.triangle);
    if (!nearer) return;
    query.best = {args->primID, t};
    query.t_max = t;
    RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, args->N), args->N, 0) = static_cast<float>(t) * kFarSlack;
}

void TracedWorld::occluded_callback(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto& world = *static_cast<const TracedWorld*>(args->geometryUserPtr);
    auto& query = *reinterpret_cast<Query*>(args->context);
    double t = 0.0;
    if (!world.blocks(*query.ray, query.t_max, query.layers, query.start_triangle, args->primID, t)) return;
    if (query.farthest) {
        // Leaves the ray as long as it is: Embree then offers every triangle along it.
        const SurfaceHit& best = query.best;
        const bool farther =
            best.triangle == kNoTriangle || t > best.t || (t >= best.t && args->primID < best.triangle);
        if (farther) query.best = {args->primID, t};
        return;
    }
    query.best = {args->primID, t};
    RTCRayN_tfar(args->ray, args->N, 0) = -std::numeric_limits<float>::infinity();
}

}  // namespace gnomon::oracle
