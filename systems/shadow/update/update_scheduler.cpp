#include "systems/shadow/update/update_scheduler.h"

#include <algorithm>
#include <tuple>

namespace gnomon::shadow {
namespace {

/// Orders views by error cost per ns, the cheapest to defer first. Views that must not be deferred have an infinite
/// cost and come last.
bool waits_before(const DueView& a, const DueView& b) {
    const auto rank = [](const DueView& due) { return std::tuple(due.harm / due.ns, due.key, due.view); };
    return rank(a) < rank(b);
}

bool loses_more(const DueView& a, const DueView& b) {
    return std::tuple(-a.harm, a.key, a.view) < std::tuple(-b.harm, b.key, b.view);
}

}  // namespace

std::size_t choose_waiting(double room_ns, std::vector<DueView>& due) {
    std::erase_if(due, [](const DueView& view) { return !(view.ns > 0.0); });  // deferring it frees nothing
    std::sort(due.begin(), due.end(), waits_before);  // also makes the sum independent of the input order
    double sum_ns = 0.0;
    for (const DueView& view : due) {
        sum_ns += view.ns;
        room_ns = std::max(room_ns, view.ns);
    }
    if (sum_ns <= room_ns) return 0;
    auto end = due.begin();
    while (end != due.end() && end->harm < DueView::kMustNotWait && sum_ns > room_ns) sum_ns -= (end++)->ns;
    std::sort(due.begin(), end, loses_more);
    const auto waits = std::stable_partition(due.begin(), end, [&](const DueView& view) {
        const bool fits = sum_ns + view.ns <= room_ns;
        if (fits) sum_ns += view.ns;
        return !fits;
    });
    return static_cast<std::size_t>(waits - due.begin());
}

}  // namespace gnomon::shadow
