#include <algorithm>

#include "systems/shadow/maps/map_cache.h"

/// Room for maps: what is freed where a limit leaves none.
namespace gnomon::shadow {

/// Evicts the spare cache if that makes room for `bytes_more`. Returns whether anything was evicted.
bool MapCache::yield_spare(std::uint64_t bytes_more) const {
    if (!spare_ || spare_->bytes() == 0 || spare_->bytes() <= room() - std::min(room(), bytes_more)) return false;
    spare_->release();
    return true;
}

/// Returns the map of an unseen light that was not seen for the longest time; null: there is none.
CachedMap* MapCache::least_recently_seen() {
    CachedMap* unseen = nullptr;
    for (CachedMap& cached : lights_) {
        const bool is_seen = cached.last_wanted_frame == frame_;
        if (cached.texture && !is_seen && (!unseen || cached.last_wanted_frame < unseen->last_wanted_frame))
            unseen = &cached;
    }
    return unseen;
}

/// Frees maps of unseen lights until the rest fits into the keep limit beside `wanted_bytes` of seen ones.
void MapCache::evict_unseen(std::uint64_t wanted_bytes) {
    if (keep_limit_ == kNoLimit) return;
    std::uint64_t kept = 0;
    for (const CachedMap& cached : lights_)
        if (cached.last_wanted_frame != frame_) kept += bytes(cached);
    while (kept > 0 && (wanted_bytes > keep_limit_ || kept > keep_limit_ - wanted_bytes)) {
        CachedMap* const unseen = least_recently_seen();
        if (!unseen) return;
        kept -= bytes(*unseen);
        release(*unseen);
    }
}

std::uint64_t MapCache::copy_room() const {
    std::uint64_t room = 0;
    for (const CachedMap& map : lights_)
        if (map.still.is_worth_room) room += static_copy_bytes(map);
    return room;
}

/// Evicts until `bytes_more` fit, in this order: the spare cache, unused maps (least recently used first), static
/// copies, the map to be replaced. Returns false if they still do not fit.
bool MapCache::make_room(std::uint64_t bytes_more, CachedMap* replaced) {
    if (limit_ == kNoLimit) return true;
    yield_spare(bytes_more);
    for (std::uint64_t taken = bytes(); taken > limit_ || bytes_more > limit_ - taken; taken = bytes()) {
        CachedMap* const unseen = least_recently_seen();
        CachedMap* apart = nullptr;
        for (CachedMap& cached : lights_)
            if (cached.still.texture) apart = &cached;
        if (unseen)
            release(*unseen);
        else if (apart)
            release_static_copy(apart->still);
        else if (replaced && replaced->texture)
            release(*replaced);
        else
            return false;
    }
    return true;
}

}  // namespace gnomon::shadow
