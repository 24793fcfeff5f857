#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/accuracy/reference_images.h"
#include "bench/common/configuration.h"
#include "bench/compare/metrics_row.h"

namespace gnomon::bench {

/// One light in one row.
struct LightRow {
    std::string light;
    LightKind kind = LightKind::point;
    std::string state, reason;  // words of its report, as in --stats
    RowFigures figures;
};
/// One row, a LightRow per shadowed light of its kinds, or why there is none.
struct JudgedRow {
    std::string name;
    std::optional<std::string> error;  // one line
    std::vector<LightRow> lights;
};

/// Called with what a light's visibility was measured to be, while the picture that it was measured in can be read.
using OnMeasured = std::function<void(const TracedLight& light, const std::vector<float>& measured)>;

struct JudgeOptions {
    bool edges = true;  // places on edges against what is predicted there; costs rays
    OnMeasured on_measured = {};
};

/// Judges a row in everything except its times. A row that fails has an error; nothing is thrown.
JudgedRow judge_row(Stage& stage, const TracedTruths& truths, const RowSetup& row, const JudgeOptions& options);

}  // namespace gnomon::bench
