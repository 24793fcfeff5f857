#include "engine/mesh/half_edges.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::assets {
namespace {

/// Half-edge in the bucket of its smaller vertex.
struct Entry {
    std::uint32_t larger_vertex = 0;
    std::uint32_t half_edge = 0;
};

struct Buckets {
    std::vector<std::size_t> begin;  // vertex_count + 1 entries
    std::vector<Entry> entries;
};

Buckets sorted_by_smaller_vertex(const std::vector<WeldedFace>& faces, std::uint32_t vertex_count) {
    Buckets buckets;
    buckets.begin.assign(std::size_t{vertex_count} + 1, 0);
    const auto each = [&](auto&& use) {
        for (std::size_t f = 0; f < faces.size(); ++f) {
            for (std::size_t c = 0; c < 3; ++c) {
                const auto [smaller, larger] = std::minmax(faces[f][c], faces[f][(c + 1) % 3]);
                use(smaller, larger, static_cast<std::uint32_t>(3 * f + c));
            }
        }
    };
    each([&](std::uint32_t smaller, std::uint32_t, std::uint32_t) { ++buckets.begin[smaller + 1]; });
    for (std::size_t v = 0; v < vertex_count; ++v) buckets.begin[v + 1] += buckets.begin[v];
    buckets.entries.resize(faces.size() * 3);
    std::vector<std::size_t> at(buckets.begin.begin(), buckets.begin.end() - 1);
    each([&](std::uint32_t smaller, std::uint32_t larger, std::uint32_t half_edge) {
        buckets.entries[at[smaller]++] = {larger, half_edge};
    });
    return buckets;
}

bool runs_upward(const std::vector<WeldedFace>& faces, std::uint32_t half_edge) {
    const WeldedFace& face = faces[half_edge / 3];
    return face[half_edge % 3] < face[next_half_edge(half_edge) % 3];
}

}  // namespace

EdgePairing pair_half_edges(const std::vector<WeldedFace>& faces, std::uint32_t vertex_count) {
    Buckets buckets = sorted_by_smaller_vertex(faces, vertex_count);
    EdgePairing pairing;
    pairing.opposite.assign(faces.size() * 3, kNoHalfEdge);
    pairing.cut.assign(faces.size() * 3, false);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        Entry* const begin = buckets.entries.data() + buckets.begin[v];
        Entry* const end = buckets.entries.data() + buckets.begin[v + 1];
        std::sort(begin, end, [](const Entry& a, const Entry& b) {
            return a.larger_vertex != b.larger_vertex ? a.larger_vertex < b.larger_vertex : a.half_edge < b.half_edge;
        });
        for (Entry* first = begin; first != end;) {
            Entry* last = first;
            while (last != end && last->larger_vertex == first->larger_vertex) ++last;
            const auto count = last - first;
            if (count == 2 && runs_upward(faces, first[0].half_edge) != runs_upward(faces, first[1].half_edge)) {
                pairing.opposite[first[0].half_edge] = first[1].half_edge;
                pairing.opposite[first[1].half_edge] = first[0].half_edge;
            } else if (count >= 2) {
                ++pairing.non_manifold_edges;
                for (Entry* entry = first; entry != last; ++entry) {
                    pairing.cut[entry->half_edge] = true;
                    if (entry != first) pairing.cut_neighbours.push_back({entry[-1].half_edge, entry->half_edge});
                }
            }
            first = last;
        }
    }
    return pairing;
}

}  // namespace gnomon::assets
