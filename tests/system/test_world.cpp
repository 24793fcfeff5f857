#include "tests/system/test_world.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/math/aabb.h"
#include "engine/mesh/mesh_topology.h"
#include "gnomon/components.h"
#include "systems/extract/light_facts.h"

namespace gnomon {
namespace {

constexpr std::uint32_t kOpaqueMaterial = 0, kMaskedMaterial = 1, kBlendedMaterial = 2;

void add_face(assets::Mesh& mesh, const glm::vec3& middle, const glm::vec3& u, const glm::vec3& v) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        const glm::vec3 position = middle + corner.x * u + corner.y * v;
        mesh.vertices.push_back({position, normal, 0.5f * corner + 0.5f});
        mesh.bounds_ms = math::extended(mesh.bounds_ms, glm::dvec3(position));
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 2u, 3u, 0u}) mesh.indices.push_back(first + i);
}

assets::Mesh box(const char* name) {
    assets::Mesh mesh;
    mesh.name = name;
    const glm::vec3 x(0.5f, 0, 0), y(0, 0.5f, 0), z(0, 0, 0.5f);
    add_face(mesh, x, y, z);
    add_face(mesh, -x, z, y);
    add_face(mesh, y, z, x);
    add_face(mesh, -y, x, z);
    add_face(mesh, z, x, y);
    add_face(mesh, -z, y, x);
    return mesh;
}

glm::dquat looking(const glm::dvec3& along) {
    const glm::dvec3 direction = glm::normalize(along);
    const glm::dvec3 up = std::abs(direction.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    return glm::quatLookAt(direction, up);
}

}  // namespace

assets::MeshLibrary test_library() {
    assets::MeshLibrary library;
    library.materials.resize(3);
    library.materials[kMaskedMaterial].alpha_mode = assets::AlphaMode::mask;
    library.materials[kBlendedMaterial].alpha_mode = assets::AlphaMode::blend;
    assets::Mesh plane;
    plane.name = "plane";
    add_face(plane, {}, {0, 0, 10}, {10, 0, 0});
    library.meshes = {plane, box("box"), box("masked"), box("blended"), box("mixed"), box("solid")};
    const std::array<std::uint32_t, 4> materials = {kOpaqueMaterial, kOpaqueMaterial, kMaskedMaterial, kBlendedMaterial};
    for (std::size_t m = 0; m < materials.size(); ++m)
        library.meshes[m].submeshes = {{0, static_cast<std::uint32_t>(library.meshes[m].indices.size()), materials[m]}};
    const auto half = static_cast<std::uint32_t>(library.meshes[kMixedBox].indices.size() / 2);
    library.meshes[kMixedBox].submeshes = {{0, half, kOpaqueMaterial}, {half, half, kMaskedMaterial}};
    assets::Mesh& solid = library.meshes[kSolidBox];
    solid.submeshes = {{0, static_cast<std::uint32_t>(solid.indices.size()), kOpaqueMaterial}};
    solid.topology = assets::analyse_topology(solid);
    return library;
}

ecs::Entity TestWorld::add_mesh(std::uint32_t mesh, const glm::dvec3& at_m, bool casts) {
    const ecs::Entity e = registry.create();
    registry.emplace<Transform>(e, {at_m});
    registry.emplace<MeshRef>(e, {mesh});
    if (casts) registry.emplace<ShadowCaster>(e);
    return e;
}

ecs::Entity TestWorld::add_camera(const glm::dvec3& at_m, const glm::dvec3& target_m) {
    const ecs::Entity e = registry.create();
    registry.emplace<Transform>(e, {at_m, looking(target_m - at_m)});
    registry.emplace<Camera>(e);
    return e;
}

ecs::Entity TestWorld::add_light(LightKind kind, const glm::dvec3& at_m, const std::string& name, bool shadow) {
    const ecs::Entity e = registry.create();
    Light light;
    light.kind = kind;
    if (kind != LightKind::directional) light.range_m = 30.0f;
    if (light_facts(kind).area()) light.source_radius_m = 0.1f;
    registry.emplace<Transform>(e, {at_m, looking(-at_m)});
    registry.emplace<Light>(e, light);
    registry.emplace<Name>(e, {name});
    LightShadow with_filter;
    with_filter.filter = ShadowFilter::hardware_2x2;  // set, so that no test depends on the default
    if (shadow) registry.emplace<LightShadow>(e, with_filter);
    return e;
}

void TestWorld::move(ecs::Entity e, const glm::dvec3& to_m) {
    registry.patch<Transform>(e, [&](Transform& t) { t.translation_m = to_m; });
}

void TestWorld::look_lights_up() {
    registry.each<LightShadow>([&](ecs::Entity e, const LightShadow&) {
        edit_light(registry, e, [](ShadowTuning& t) { t.reuse.keep_visibility = false; });
    });
}

TestWorld::Stage TestWorld::add_stage() {
    return {add_mesh(kPlane, {0, 0, 0}, false), add_mesh(kBox, {0, 1, 0}, true), add_camera({0, 4, 8}, {0, 0, 0})};
}

}  // namespace gnomon
