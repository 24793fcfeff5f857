#pragma once
#include <string>
#include <utility>
#include <vector>

#include "bench/sweep/sweep.h"

namespace gnomon::bench {

/// A row with the error and the time of one light, "sun", each against the defaults.
struct MadeUpRow {
    std::string name;
    double error = 0.0, cost = 0.0;
    std::string factor = "filter";
};

inline SceneSweep made_up_sweep(const std::vector<MadeUpRow>& rows) {
    SceneSweep sweep;
    sweep.scene = "a scene";
    sweep.device = "a device";
    sweep.size_px = {320, 180};
    sweep.rounds = 3;
    for (const MadeUpRow& row : rows) {
        SweepRow planned;
        planned.name = row.name;
        planned.factor = row.factor;
        planned.settings = {"filter=" + row.name};
        sweep.plan.push_back(planned);
        JudgedRow& judged = sweep.rows.emplace_back();
        judged.name = row.name;
        LightRow& light = judged.lights.emplace_back();
        light.light = "sun";
        light.kind = LightKind::directional;
        light.state = "rendered";
        light.figures.scored_px = 1.0e6;
        light.figures.wrong = row.error;
        light.figures.gpu_ratio = {row.cost, row.cost, row.cost, 3};
    }
    return sweep;
}

}  // namespace gnomon::bench
