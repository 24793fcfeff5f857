#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/common/stage.h"
#include "gnomon/result.h"
#include "tests/oracle/area_truth.h"
#include "tests/oracle/metrics.h"

/// Shadows that another renderer drew, against ray-traced truth.
namespace gnomon::bench {

struct JudgedPicture {
    std::string light;
    oracle::Metrics metrics;
    std::optional<oracle::AreaMetrics> area;  // empty: not wanted
};
struct JudgedFolder {
    std::string folder;
    std::vector<JudgedPicture> lights;  // lights with a LightShadow
};
struct JudgedPictures {
    std::string scene;
    glm::uvec2 size_px{0, 0};
    std::vector<JudgedFolder> folders;
};

struct JudgePicturesOptions {
    std::vector<std::string> folders;  // with <light>.pfm, as the game's --visibility writes them
    std::uint32_t area_side = 0;   // places along the side of a pixel's area, oracle::AreaSampling; 0: no such truth
    bool pictures = false;         // writes <light>.png beside each file: visibility in grey, wrong pixels in red
};

/// Compares pictures of visibility with rays through the same camera, traced once for all folders. Errors: "input.read" for a light without a
/// picture, "bench.size" for a picture of another size than the stage's, "bench.camera", "output.write".
Result<JudgedPictures> judge_pictures(Stage& stage, const JudgePicturesOptions& options);

/// Returns the meaning of the table's columns, for --help.
std::string judge_legend();
/// Returns a table for people.
std::string judge_table(const JudgedPictures& judged);
/// Returns all figures for scripts.
std::string judge_json(const JudgedPictures& judged);

}  // namespace gnomon::bench
