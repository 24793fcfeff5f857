#include "systems/shadow/frame/receiver_caster_sets.h"

namespace gnomon::shadow {
namespace {

template <class T>
IndexRange append(const std::vector<T>& from, IndexRange range, std::vector<T>& to) {
    const IndexRange there{static_cast<std::uint32_t>(to.size()), range.count};
    const std::span<const T> items = slice(from, range);
    to.insert(to.end(), items.begin(), items.end());
    return there;
}

}  // namespace

LightSets append_sets(const ReceiverCasterSets& from, const LightSets& sets, ReceiverCasterSets& to) {
    LightSets there;
    there.receivers = append(from.receiver_items, sets.receivers, to.receiver_items);
    there.casters = append(from.caster_items, sets.casters, to.caster_items);
    there.receiver_points = append(from.receiver_points_ws, sets.receiver_points, to.receiver_points_ws);
    there.error_points = append(from.error_points_ws, sets.error_points, to.error_points_ws);
    there.hulls = append(from.hulls, sets.hulls, to.hulls);
    for (std::uint32_t h = there.hulls.first; h < there.hulls.end(); ++h) {
        ReceiverHull& hull = to.hulls[h];
        if (hull.receiver_points.count > 0)
            hull.receiver_points.first += there.receiver_points.first - sets.receiver_points.first;
        hull.outline = append(from.outlines, hull.outline, to.outlines);
    }
    return there;
}

void reserve_as(const ReceiverCasterSets& all, ReceiverCasterSets& sets) {
    sets.receiver_items.reserve(all.receiver_items.capacity());
    sets.caster_items.reserve(all.caster_items.capacity());
    sets.receiver_points_ws.reserve(all.receiver_points_ws.capacity());
    sets.error_points_ws.reserve(all.error_points_ws.capacity());
    sets.hulls.reserve(all.hulls.capacity());
    sets.outlines.reserve(all.outlines.capacity());
}

}  // namespace gnomon::shadow
