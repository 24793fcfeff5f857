#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "engine/core/result.h"

namespace gnomon::bench {

/// What early bailing saves one light, counted by the shaders' own text in double: a tap is a call.
struct TapCount {
    std::string light;
    std::size_t points = 0;         // on surfaces in view that the light shines on
    double all = 0.0, early = 0.0;  // mean fetches per point, without and with it
    std::size_t changed = 0;        // points whose visibility it changes, however little
    std::size_t wrong = 0;          // those that it takes from one side of 1/2 to the other
    double saved() const { return all > 0.0 ? 1.0 - early / all : 0.0; }
    double share(std::size_t some) const {
        return points > 0 ? static_cast<double>(some) / static_cast<double>(points) : 0.0;
    }
};

/// With the filter that the stage's lights have. Errors: "bench.camera", "bench.map", "gpu.scene", "bench.row" for a
/// filter that is not compiled in.
Result<std::vector<TapCount>> count_taps(Stage& stage, std::uint32_t points);

struct FilterPicturesOptions {
    std::uint32_t points = 20000;
    std::string only;  // rows whose name has this part; empty: all
};

/// Names of pictures, the truth's first, and a table of figures in Markdown: of rows that take the light as a point,
/// and of what is judged by disk_source().
struct FilterPictures {
    std::vector<std::string> point = {"truth"}, disk = {"truth_disk"};
    std::string point_figures, disk_figures;
};

/// Every row of the filter table, some with several settings: taps, half-width and error of each light, and in `folder`
/// a picture of the first light's visibility, beside the truth, where that has the most edges.
/// Errors as of measure_accuracy and count_taps, and "output.*".
Result<FilterPictures> write_filter_pictures(Stage& stage, const std::filesystem::path& folder,
                                             const FilterPicturesOptions& options);

/// The pictures side by side, in Markdown. `folder`: as the page names it.
std::string picture_table(const std::vector<std::string>& names, const std::string& folder);

}  // namespace gnomon::bench
