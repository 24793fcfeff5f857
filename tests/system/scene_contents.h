#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "engine/gl/device_recording.h"
#include "systems/extract/gpu_scene.h"

/// What a device holds of a scene's meshes, against the library.
namespace gnomon {

/// Copies `count` values that lie in a buffer from number `first` on.
template <class T>
std::vector<T> values_in(const gl::RecordingDevice& device, gl::BufferHandle buffer, std::size_t first, std::size_t count) {
    std::vector<T> values(count);
    const auto bytes = device.buffer_bytes(buffer);
    if ((first + count) * sizeof(T) > bytes.size()) {
        ADD_FAILURE() << "beyond the buffer: " << first << " + " << count;
        return values;
    }
    if (count > 0) std::memcpy(values.data(), bytes.data() + first * sizeof(T), count * sizeof(T));
    return values;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Compares a masked triangle's words with those of masks made of the library alone. Where texels begin may differ.
inline void expect_mask(const std::vector<std::uint32_t>& words, const CasterTriangle& triangle, const RayMasks& fresh,
                        const RayMasks::Place& place, std::size_t uv_words) {
    constexpr std::size_t kTexels = 2, kWidth = 3;  // fields of RayMask, in words
    const std::uint32_t mask = triangle.corners[1].across, uvs = triangle.corners[2].across;
    ASSERT_LE(mask + sizeof(RayMask) / 4, words.size());
    ASSERT_LE(uvs + uv_words, words.size());
    for (std::size_t w = 0; w < uv_words; ++w) ASSERT_EQ(words[uvs + w], fresh.words()[place.uvs + w]);
    for (std::size_t w = 0; w < sizeof(RayMask) / 4; ++w) {
        if (w != kTexels) { ASSERT_EQ(words[mask + w], fresh.words()[place.mask + w]) << w; }
    }
    const std::uint32_t texels = words[mask + kTexels], right = fresh.words()[place.mask + kTexels];
    if (right == ~0u) { ASSERT_EQ(texels, ~0u); }
    const std::size_t count = right == ~0u ? 0 : (words[mask + kWidth] * words[mask + kWidth + 1] + 3) / 4;
    for (std::size_t t = 0; t < count; ++t) ASSERT_EQ(words[texels + t], fresh.words()[right + t]);
}

/// Compares a mesh's caster triangles, and what their masks say.
inline void expect_casters(const gl::RecordingDevice& device, const GpuScene& gpu, std::uint32_t m,
                           const std::vector<std::uint32_t>& words, RayMasks& fresh) {
    const assets::Mesh& mesh = gpu.library().meshes[m];
    const std::uint32_t first = gpu.mesh(m).first_index / 3;
    std::vector<CasterTriangle> right;
    append_caster_triangles(gpu.library(), m, first, fresh, right);
    const auto records = values_in<CasterTriangle>(device, gpu.caster_triangles(), first, right.size());
    for (std::size_t t = 0; t < right.size(); ++t) {
        ASSERT_EQ(records[t].masked(), right[t].masked());
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(records[t].corners[c].position_ms, right[t].corners[c].position_ms);
            if (!right[t].masked()) { ASSERT_EQ(records[t].corners[c].across, right[t].corners[c].across); }
        }
        const RayMasks::Place place{right[t].corners[1].across, right[t].corners[2].across};
        if (right[t].masked()) expect_mask(words, records[t], fresh, place, mesh.colours.empty() ? 6 : 9);
    }
}

/// Compares all that the device has of each placed mesh, at rest, with the library. Returns how many were compared.
inline std::size_t expect_contents(const gl::RecordingDevice& device, const GpuScene& gpu) {
    const assets::MeshLibrary& library = gpu.library();
    RayMasks fresh(library);
    const std::size_t word_count = gpu.caster_masks() ? device.buffer_bytes(gpu.caster_masks()).size() / 4 : 0;
    const auto words = values_in<std::uint32_t>(device, gpu.caster_masks(), 0, word_count);
    std::size_t compared = 0;
    for (std::uint32_t m = 0; m < gpu.mesh_count(); ++m) {
        const assets::Mesh& mesh = library.meshes[m];
        const GpuScene::MeshRange& range = gpu.mesh(m);
        if (range.triangles == 0) continue;
        SCOPED_TRACE("mesh " + std::to_string(m));
        ++compared;
        const auto base = static_cast<std::size_t>(range.base_vertex);
        const std::size_t first = range.first_index / 3, triangles = mesh.indices.size() / 3;
        EXPECT_EQ(range.triangles, triangles);
        EXPECT_EQ(values_in<assets::Vertex>(device, gpu.vertices(), base, mesh.vertices.size()), mesh.vertices);
        EXPECT_EQ(values_in<std::uint32_t>(device, gpu.indices(), range.first_index, mesh.indices.size()), mesh.indices);
        std::vector<glm::vec4> normals, colours;
        append_plane_normals(mesh.vertices, mesh.indices, normals);
        EXPECT_TRUE(same_bytes(values_in<glm::vec4>(device, gpu.triangle_normals(), first, triangles), normals));
        append_colours(mesh, colours);
        if (gpu.colours()) { EXPECT_TRUE(same_bytes(values_in<glm::vec4>(device, gpu.colours(), base, colours.size()), colours)); }
        EXPECT_TRUE(gpu.colours() || mesh.colours.empty());
        for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
            EXPECT_EQ(gpu.submesh(range.first_submesh + s).first_index, range.first_index + mesh.submeshes[s].first_index);
            EXPECT_EQ(gpu.submesh(range.first_submesh + s).index_count, mesh.submeshes[s].index_count);
            EXPECT_EQ(gpu.submesh(range.first_submesh + s).material, mesh.submeshes[s].material);
        }
        if (gpu.caster_triangles()) expect_casters(device, gpu, m, words, fresh);
    }
    return compared;
}

}  // namespace gnomon
