#include "tests/oracle/tint_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "tests/oracle/alpha_mask.h"
#include "tests/oracle/light_reach.h"
#include "tests/oracle/posed_positions.h"
#include "tests/oracle/triangle_test.h"

namespace gnomon::oracle {
namespace {

struct TintTriangle {
    glm::dvec3 a{0.0}, b{0.0}, c{0.0};  // relative to the origin
    const assets::Mesh* mesh = nullptr;
    const assets::Material* material = nullptr;
    std::uint32_t first_index = 0;
};

double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

double wrapped(double texel, double edge, assets::TextureWrap wrap) {
    if (wrap == assets::TextureWrap::clamp) return glm::clamp(texel, 0.0, edge - 1.0);
    if (wrap == assets::TextureWrap::repeat) return texel - edge * std::floor(texel / edge);
    const double both = texel - 2.0 * edge * std::floor(texel / (2.0 * edge));
    return both < edge ? both : 2.0 * edge - 1.0 - both;
}

glm::dvec4 texel_of(const assets::Texture& texture, double x, double y) {
    const auto column = static_cast<std::size_t>(wrapped(x, texture.width, texture.wrap_u));
    const auto row = static_cast<std::size_t>(wrapped(y, texture.height, texture.wrap_v));
    const std::uint8_t* rgba = &texture.rgba[4 * (row * texture.width + column)];
    return {linear_of(rgba[0] / 255.0), linear_of(rgba[1] / 255.0), linear_of(rgba[2] / 255.0), rgba[3] / 255.0};
}

glm::dvec4 sampled(const assets::Texture& texture, const glm::dvec2& uv) {
    const glm::dvec2 at = uv * glm::dvec2(texture.width, texture.height);
    if (!texture.linear_filter) return texel_of(texture, std::floor(at.x), std::floor(at.y));
    const glm::dvec2 first = glm::floor(at - 0.5), part = at - 0.5 - first;
    const auto row = [&](double y) {
        return glm::mix(texel_of(texture, first.x, y), texel_of(texture, first.x + 1.0, y), part.x);
    };
    return glm::mix(row(first.y), row(first.y + 1.0), part.y);
}

/// Returns whether an instance with a mesh casts shadows of the light.
bool casts_for(const InstanceItem& item, const assets::MeshLibrary& library, const LightItem& light) {
    return item.casts && (item.cast_layers & light.shadow.layers) != 0 && item.mesh < library.meshes.size();
}

std::vector<TintTriangle> tint_triangles(const SceneSnapshot& scene, const assets::MeshLibrary& library,
                                         const glm::dvec3& origin_ws_m, const LightItem& light) {
    std::vector<TintTriangle> triangles;
    for (const InstanceItem& item : scene.instances) {
        if (!casts_for(item, library, light)) continue;
        const assets::Mesh& mesh = library.meshes[item.mesh];
        const std::vector<glm::dvec3> positions = posed_positions(scene, library, item.mesh);
        const glm::dvec3 translation = item.translation_ws_m - origin_ws_m;
        const auto place = [&](std::uint32_t i) { return item.basis * positions[mesh.indices[i]] + translation; };
        for (const assets::Submesh& part : mesh.submeshes) {
            const assets::Material& material = library.materials[part.material];
            if (!assets::transmits(material)) continue;
            for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3)
                triangles.push_back({place(i), place(i + 1), place(i + 2), &mesh, &material, i});
        }
    }
    return triangles;
}

/// Returns whether the side p to q, which the ray meets exactly, belongs to a triangle that turns as `turn` does.
bool owns_side(const glm::dvec3& p, const glm::dvec3& q, double turn) {
    for (int i = 0; i < 3; ++i)
        if (p[i] != q[i]) return (p[i] < q[i]) == (turn > 0.0);
    return false;
}

/// Returns whether the hit counts: inside, or on a side that this triangle owns of the two that have it.
bool counts(const TintTriangle& t, const ExactRay& ray, const ExactHit& hit) {
    const double turn = glm::dot(glm::cross(t.b - t.a, t.c - t.a), ray.direction);
    return (hit.u != 0.0 || owns_side(t.b, t.c, turn)) && (hit.v != 0.0 || owns_side(t.c, t.a, turn)) &&
           (hit.w != 0.0 || owns_side(t.a, t.b, turn));
}

glm::dvec3 transmittance_at(const assets::MeshLibrary& library, const TintTriangle& t, const ExactHit& hit) {
    glm::dvec2 uv(0.0);
    glm::dvec4 colour(1.0);
    if (!t.mesh->colours.empty()) colour = glm::dvec4(0.0);
    const double weights[3] = {hit.u, hit.v, hit.w};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = t.mesh->indices[t.first_index + i];
        uv += weights[i] * glm::dvec2(t.mesh->vertices[vertex].uv);
        if (!t.mesh->colours.empty()) colour += weights[i] * glm::dvec4(t.mesh->colours[vertex]);
    }
    return surface_transmittance(library, *t.material, uv, colour);
}

/// Distance from a plane within which a place lies on it, in sizes of the coordinates: a few dozen roundings of double.
constexpr double kOnPlane = 1.0e-12;

bool is_on_plane(const TintTriangle& t, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double size = glm::length(t.a) + glm::length(point) + 1.0;
    return std::abs(glm::dot(normal, point - t.a)) <= kOnPlane * size * glm::length(normal);
}

}  // namespace

glm::dvec3 surface_transmittance(const assets::MeshLibrary& library, const assets::Material& material,
                                 const glm::dvec2& uv, const glm::dvec4& vertex_colour) {
    if (!passes_mask(library, material, uv, vertex_colour.a)) return glm::dvec3(1.0);
    glm::dvec4 colour = glm::dvec4(material.base_colour) * vertex_colour;
    if (material.base_colour_texture >= 0)
        colour *= sampled(library.textures[static_cast<std::size_t>(material.base_colour_texture)], uv);
    const bool blended = material.alpha_mode == assets::AlphaMode::blend;
    const double covered = blended ? glm::clamp(colour.a, 0.0, 1.0) : 1.0;
    const glm::dvec3 through = glm::dvec3(material.transmission) * glm::dvec3(colour) *
                               (1.0 - static_cast<double>(material.metallic));
    return 1.0 - covered * (1.0 - glm::clamp(through, 0.0, 1.0));
}

std::vector<glm::dvec3> trace_tint(const SceneSnapshot& scene, const assets::MeshLibrary& library,
                                   const glm::dvec3& origin_ws_m, const PrimaryHits& hits, const LightItem& light) {
    const std::vector<TintTriangle> triangles = tint_triangles(scene, library, origin_ws_m, light);
    const glm::dvec3 light_rel_m = light.position_ws_m - origin_ws_m;
    std::vector<glm::dvec3> passed(hits.count(), glm::dvec3(1.0));
    for (std::size_t pixel = 0; pixel < passed.size(); ++pixel) {
        glm::dvec3 to_light;
        double t_max = 0.0;
        const glm::dvec3& point = hits.position_rel_m[pixel];
        if (hits.triangle[pixel] == kNoTriangle || !reach(light, light_rel_m, point, to_light, t_max)) continue;
        const ExactRay ray = make_ray(point, to_light);
        for (const TintTriangle& t : triangles) {
            ExactHit hit;
            if (is_on_plane(t, point) || !intersect(ray, t.a, t.b, t.c, hit)) continue;
            if (hit.t > 0.0 && hit.t < t_max && counts(t, ray, hit)) passed[pixel] *= transmittance_at(library, t, hit);
        }
    }
    return passed;
}

bool has_translucent_casters(const SceneSnapshot& scene, const assets::MeshLibrary& library, const LightItem& light) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const InstanceItem& item) {
        if (!casts_for(item, library, light)) return false;
        const std::vector<assets::Submesh>& parts = library.meshes[item.mesh].submeshes;
        return std::any_of(parts.begin(), parts.end(), [&](const assets::Submesh& part) {
            return assets::transmits(library.materials[part.material]);
        });
    });
}

TintMetrics compare_tint(const PrimaryHits& hits, std::span<const glm::dvec3> truth,
                         std::span<const glm::vec4> measured) {
    TintMetrics m;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        if (hits.triangle[i] == kNoTriangle) continue;
        m.add(glm::abs(glm::dvec3(measured[i]) - truth[i]), truth[i] != glm::dvec3(1.0));
        m.darkest = glm::min(m.darkest, truth[i]);
    }
    m.finish();
    return m;
}

}  // namespace gnomon::oracle
