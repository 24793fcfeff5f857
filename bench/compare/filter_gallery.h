#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"

namespace gnomon::bench {

/// Savings of early bailing for one light, counted by the shaders' own text in double: a tap is a call.
struct TapCount {
    std::string light;
    std::size_t points = 0;         // on surfaces in view that the light shines on
    double all = 0.0, early = 0.0;  // mean fetches per point, without and with it
    std::size_t changed = 0;        // points with a changed visibility, however little
    std::size_t wrong = 0;          // points that it takes from one side of 1/2 to the other
    double saved() const { return all > 0.0 ? 1.0 - early / all : 0.0; }
    double share(std::size_t some) const {
        return points > 0 ? static_cast<double>(some) / static_cast<double>(points) : 0.0;
    }
};

/// Counts the taps of the filter that the stage's lights have. Errors: "bench.camera", "bench.map", "gpu.scene",
/// "bench.row" for a filter that is not compiled in.
Result<std::vector<TapCount>> count_taps(Stage& stage, std::uint32_t points);

struct FilterPicturesOptions {
    std::uint32_t points = 20000;
    std::string only;  // rows with this part in their name; empty: all
};

/// Names of pictures, the truth's first, and a table of figures in Markdown. point: rows that take the light as a
/// point; disk: rows judged by disk_source().
struct FilterPictures {
    std::vector<std::string> point = {"truth"}, disk = {"truth_disk"};
    std::string point_figures, disk_figures;
};

/// Measures taps, half-width and error of every row of the filter table, some with several settings. Writes a picture
/// of the first light's visibility into `folder`, beside the truth, where that has the most edges. Errors: as
/// measure_accuracy() and count_taps(), and "output.*".
Result<FilterPictures> write_filter_pictures(Stage& stage, const std::filesystem::path& folder,
                                             const FilterPicturesOptions& options);

/// Returns the pictures side by side, in Markdown. `folder`: as the page names it.
std::string picture_table(const std::vector<std::string>& names, const std::string& folder);

}  // namespace gnomon::bench
