#include "engine/core/range_list.h"

#include <algorithm>

namespace gnomon {

std::uint32_t RangeList::take(std::uint32_t count) {
    if (count == 0) return 0;
    const auto fits =
        std::find_if(free_.begin(), free_.end(), [count](const Range& range) { return range.count >= count; });
    if (fits == free_.end()) return kNone;
    const std::uint32_t first = fits->first;
    fits->first += count;
    fits->count -= count;
    if (fits->count == 0) free_.erase(fits);
    used_ += count;
    return first;
}

void RangeList::give(std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    used_ -= count;
    const auto after = std::lower_bound(free_.begin(), free_.end(), first,
                                        [](const Range& range, std::uint32_t place) { return range.first < place; });
    const bool joins_after = after != free_.end() && after->first == first + count;
    const bool joins_before = after != free_.begin() && std::prev(after)->end() == first;
    if (joins_before && joins_after) {
        std::prev(after)->count += count + after->count;
        free_.erase(after);
    } else if (joins_before) {
        std::prev(after)->count += count;
    } else if (joins_after) {
        after->first = first;
        after->count += count;
    } else {
        free_.insert(after, {first, count});
    }
}

std::uint32_t RangeList::end() const {
    return !free_.empty() && free_.back().end() == places_ ? free_.back().first : places_;
}

void RangeList::resize(std::uint32_t places) {
    const std::uint32_t used_end = end();
    if (used_end < places_) free_.pop_back();
    places_ = places;
    if (used_end < places_) free_.push_back({used_end, places_ - used_end});
}

}  // namespace gnomon
