#include "bench/accuracy/default_limits.h"

#include <algorithm>

#include "bench/text/printf_string.h"
#include "tests/oracle/metrics.h"

namespace gnomon::bench {
namespace {

std::string percent_words(double share) { return formatted("%.3g %%", 100.0 * share); }

std::string near_words(double errors, const std::optional<double>& far, const std::string& where) {
    if (!far) return {};
    const double near = std::max(errors - *far, 0.0) / errors;
    const std::string share = near == 1.0 ? "all" : near == 0.0 ? "none" : percent_words(near);
    return ", " + share + " of that within " + where + " of a true edge";
}

}  // namespace

std::string missed_limits(const JudgedErrors& errors) {
    std::string text;
    const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    // Leak and acne begin farther from edges than that.
    const std::string texel = "half a texel of the map",
                      texel_or_band = texel + formatted(" or %g px", oracle::kEdgeBandPx);
    std::optional<double> far;
    if (errors.false_shadow_far && errors.false_light_far) far = *errors.false_shadow_far + *errors.false_light_far;
    if (errors.wrong > kMostWrongByDefault)
        add(percent_words(errors.wrong) + " wrong (" + percent_words(kMostWrongByDefault) + ")" +
            near_words(errors.wrong, far, texel_or_band));
    if (errors.leak > kMostLeakByDefault)
        add(percent_words(errors.leak) + " leak (" + percent_words(kMostLeakByDefault) + ")" +
            near_words(errors.leak, errors.false_light_far, texel));
    if (errors.acne > 0.0)
        add(percent_words(errors.acne) + " acne (none)" + near_words(errors.acne, errors.false_shadow_far, texel));
    return text;
}

}  // namespace gnomon::bench
