#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "bench/common/stage.h"
#include "bench/pictures/edge_errors.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// A scene's edges: with one sample per pixel, smoothed, and with 64 samples.
struct Edges {
    std::string scene;
    glm::uvec2 size_px{0, 0};
    EdgePictures pictures;
    EdgeErrors errors;
};

/// Draws them. Errors: rule "bench.edges".
Result<Edges> make_edges(Stage& stage);
/// Writes the part with most edges, enlarged to 200 %, the three beside each other.
std::optional<Error> write_edges(const Edges& edges, const std::filesystem::path& file);
/// Returns how far the first two are from the last, as a table.
std::string edges_table(const Edges& edges);

}  // namespace gnomon::bench
