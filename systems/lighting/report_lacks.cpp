#include "systems/lighting/report_lacks.h"

#include <algorithm>

namespace gnomon::lighting {

void report_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report) {
    if (lack.reason == Reason::none) return;
    if (lack.unshadowed) {
        report.state = LightState::skipped;
        report.reason = lack.reason;
        report.filter = {};
        report.predicted_error_px = report.why.stale_px = 0.0;
        report.keeps_max_error = false;
        report.views = report.view_count = 0;
    } else if (report.state != LightState::skipped) {  // in no other picture
        const bool again = report.filter.filter == plain.filter && report.filter.reason == lack.reason;
        report.state = LightState::degraded;
        report.reason = lack.reason;
        report.filter = {plain.filter, lack.reason, {}};
        report.predicted_error_px =
            again ? std::max(report.predicted_error_px, plain.predicted_error_px) : plain.predicted_error_px;
        report.keeps_max_error = plain.keeps_max_error && (!again || report.keeps_max_error);
    }
}

void report_blended_lack(const Lack& lack, const shadow::LookupAccuracy& plain, LightReport& report) {
    if (lack.reason == Reason::none) return;
    if (report.state == LightState::skipped) return;
    report.state = LightState::degraded;
    report.reason = lack.reason;
    report.predicted_error_px = std::max(report.predicted_error_px, plain.predicted_error_px);
    report.keeps_max_error = report.keeps_max_error && !lack.unshadowed && plain.keeps_max_error;
}

}  // namespace gnomon::lighting
