#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/math/rounding.h"
#include "engine/mesh/mesh_weld.h"
#include "engine/mesh/proxies/coarser_surface.h"
#include "gnomon/assets.h"

/// Proxies as meshes of a library.
namespace gnomon::assets {
namespace {

/// Opaque faces of a mesh, over welded points.
struct OpaqueSurface {
    std::vector<glm::dvec3> points;
    std::vector<glm::vec3> positions;  // the same, as they are stored
    std::vector<WeldedFace> faces;
    std::uint32_t material = 0;  // that casts as all of them do: double-sided if any is
};

/// Collects what opaque parts of a mesh show. Without faces if a point is not finite.
OpaqueSurface opaque_surface(const MeshLibrary& library, const Mesh& mesh) {
    OpaqueSurface surface;
    const std::vector<std::uint32_t> welded = weld_by_position(mesh.vertices);
    for (std::size_t v = 0; v < welded.size(); ++v) {
        const glm::vec3& p = mesh.vertices[v].position_ms;
        if (!std::isfinite(p.x + p.y + p.z)) return {};
        if (welded[v] < surface.points.size()) continue;
        surface.points.emplace_back(p);
        surface.positions.push_back(p);
    }
    bool any = false;
    for (const Submesh& submesh : mesh.submeshes) {
        const Material& material = library.materials[submesh.material];
        if (!is_opaque(material)) continue;
        if (!any || (material.double_sided && !library.materials[surface.material].double_sided))
            surface.material = submesh.material;
        any = true;
        for (std::uint32_t i = submesh.first_index; i + 2 < submesh.first_index + submesh.index_count; i += 3)
            surface.faces.push_back(
                {welded[mesh.indices[i]], welded[mesh.indices[i + 1]], welded[mesh.indices[i + 2]]});
    }
    return surface;
}

/// Appends a vertex of the proxy for each number that is new.
class VertexPicker {
public:
    VertexPicker(std::size_t count, std::vector<Vertex>& out) : place_(count, kNone), out_(out) {}
    std::uint32_t pick(std::uint32_t number, const Vertex& vertex) {
        if (place_[number] == kNone) {
            place_[number] = static_cast<std::int32_t>(out_.size());
            out_.push_back(vertex);
        }
        return static_cast<std::uint32_t>(place_[number]);
    }

private:
    std::vector<std::int32_t> place_;
    std::vector<Vertex>& out_;
};

/// Makes the mesh of coarser opaque faces and the same masked parts.
Mesh proxy_of(const MeshLibrary& library, const Mesh& mesh, const OpaqueSurface& surface,
              const CoarserSurface& coarser) {
    Mesh proxy;
    proxy.name = mesh.name + " (proxy)";
    VertexPicker opaque(surface.points.size(), proxy.vertices), masked(mesh.vertices.size(), proxy.vertices);
    for (const WeldedFace& face : coarser.faces)
        for (const std::uint32_t point : face)
            proxy.indices.push_back(opaque.pick(point, Vertex{.position_ms = surface.positions[point]}));
    proxy.submeshes.push_back({0, static_cast<std::uint32_t>(proxy.indices.size()), surface.material});
    for (const Submesh& submesh : mesh.submeshes) {
        const Material& material = library.materials[submesh.material];
        if (material.alpha_mode != AlphaMode::mask || transmits(material)) continue;
        const auto first = static_cast<std::uint32_t>(proxy.indices.size());
        for (std::uint32_t i = 0; i < submesh.index_count; ++i) {
            const std::uint32_t vertex = mesh.indices[submesh.first_index + i];
            proxy.indices.push_back(masked.pick(vertex, mesh.vertices[vertex]));
        }
        proxy.submeshes.push_back({first, submesh.index_count, submesh.material});
    }
    complete(proxy);
    return proxy;
}

}  // namespace

std::uint32_t add_proxies(MeshLibrary& library) {
    std::uint32_t count = 0;
    std::vector<bool> is_proxy(library.meshes.size(), false);
    for (const Mesh& mesh : library.meshes)
        for (const MeshProxy& proxy : mesh.proxies) is_proxy[proxy.mesh] = true;
    for (std::uint32_t m = 0; m < is_proxy.size(); ++m) {
        const Mesh& mesh = library.meshes[m];
        if (is_proxy[m] || !mesh.proxies.empty() || mesh.deformer || !mesh.colours.empty()) continue;
        const OpaqueSurface surface = opaque_surface(library, mesh);
        std::vector<std::pair<Mesh, float>> made;
        for (const CoarserSurface& coarser : coarser_surfaces(surface.points, surface.faces))
            if (!coarser.faces.empty())
                made.emplace_back(proxy_of(library, mesh, surface, coarser), math::at_least(coarser.bound_m));
        std::vector<MeshProxy> proxies;
        for (auto& [proxy, bound_m] : made) proxies.push_back({library.add(std::move(proxy)), bound_m});
        count += static_cast<std::uint32_t>(proxies.size());
        library.meshes[m].proxies = std::move(proxies);
    }
    return count;
}

}  // namespace gnomon::assets
