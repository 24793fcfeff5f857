// A tool that reads glTF files and draws nothing. Exit code 0: the mesh is as in the file.
#include <gnomon/assets.h>

#include <cstdio>
#include <span>
#include <string_view>

namespace {

/// One triangle, with its numbers in the file.
constexpr std::string_view kFile = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0, "translation": [1, 2, 3]}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

}  // namespace

int main() {
    const auto scene = gnomon::assets::load_gltf_memory(std::as_bytes(std::span(kFile)), {}, "triangle");
    if (!scene) {
        std::fprintf(stderr, "load_only: %s\n", gnomon::to_line(scene.error()).c_str());
        return 1;
    }
    const gnomon::assets::Mesh& mesh = scene.value().meshes.at(0);
    gnomon::assets::Mesh own = mesh;
    gnomon::assets::complete(own);
    const bool good = mesh.indices.size() == 3 && mesh.topology.boundary_edges == 3 && !mesh.topology.closed &&
                      own.topology.boundary_edges == 3 && own.bounds_ms == mesh.bounds_ms && own.shape != nullptr &&
                      scene.value().nodes.at(0).translation_m == glm::dvec3(1.0, 2.0, 3.0);
    std::printf("%zu indices, %u boundary edges\n", mesh.indices.size(), mesh.topology.boundary_edges);
    return good ? 0 : 1;
}
