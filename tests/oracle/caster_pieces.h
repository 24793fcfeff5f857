#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "gnomon/assets.h"
#include "systems/extract/snapshot.h"
#include "tests/oracle/reference_tracer.h"

namespace gnomon::oracle {

/// Pieces of casters, as a light sees them: triangles that share edges and turn the same side to the light. A twig is a
/// piece, whatever else its mesh holds, and so is each fold of a cloth. A triangle that an alpha mask cuts is one by
/// itself, since no sheet continues across its edges.
class CasterPieces {
public:
    /// Finds which triangles share edges, by the places of their corners. All arguments must outlive it.
    CasterPieces(const ReferenceTracer& tracer, const SceneSnapshot& snapshot, const assets::MeshLibrary& library);

    /// Returns a number per triangle of the tracer, the same for triangles of one piece.
    std::vector<std::uint32_t> seen_from(const LightItem& light) const;

private:
    using Edges = std::vector<std::array<std::uint32_t, 2>>;  // pairs of a mesh's triangles that share an edge

    const ReferenceTracer& tracer_;
    const SceneSnapshot& snapshot_;
    std::map<std::uint32_t, Edges> edges_;                         // by mesh
    std::vector<std::map<std::uint32_t, std::uint32_t>> numbers_;  // by instance: tracer's triangle of a mesh's
};

}  // namespace gnomon::oracle
