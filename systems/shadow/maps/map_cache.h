#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/components.h"
#include "gnomon/light.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/retry.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/map_assignment.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/maps/shown_casters.h"
#include "systems/shadow/maps/static_copy.h"
#include "systems/shadow/request/map_textures.h"
#include "systems/spare_memory.h"

namespace gnomon::shadow {

/// Prefiltered map: moments of a depth map's distances, layer by layer, and scratch storage between its blur's two
/// passes.
struct PrefilterTextures {
    gl::TextureDesc desc{.width = 0}, scratch_desc{.width = 0};  // width 0: there is none
    gl::TextureHandle texture{}, scratch{};
    std::vector<gl::TargetHandle> targets;  // one per layer
    gl::TargetHandle scratch_target{};
    std::vector<std::uint64_t> content;  // per layer, as MapLayers::content
};

/// Conservative map beside a depth map of FilterStorage::conservative_bounds (BoundsDescs). CachedMap::triangles has
/// the triangle that each texel shows.
struct BoundsTextures {
    gl::TextureHandle second{}, bounds{};  // {0}: there is none
    gl::BufferHandle ends{};               // FilterStorage::occluder_pyramid (occluder_pyramid.h); {0}: none
    std::vector<gl::TargetHandle> second_targets, bounds_targets;  // one per layer
};

/// What the layers of a light's map hold, and where they are drawn. One entry per layer in each.
struct MapLayers {
    std::vector<gl::TargetHandle> targets;
    std::vector<std::uint64_t> content;     // hash of what was drawn, 0: nothing
    std::vector<std::uint64_t> placements;  // its ContentSignature::placement
    std::vector<ShownCasters> shown;        // for lights with maps that may be kept; else empty
};

/// How the allocation of a light's map went.
struct MapAllocation {
    std::uint32_t wanted_px = 0;    // size requested when the map was made
    Reason failure = Reason::none;  // why there is no map, or a smaller one
    std::uint64_t retry_frame = 0;  // frame from which a failed allocation may be tried again
};

/// State of one light that outlives a frame: its map, and what each layer shows.
struct CachedMap {
    ecs::Entity entity;
    gl::TextureDesc desc;
    gl::TextureHandle texture{};
    FilterStorage storage{};        // what the map was made for
    gl::TextureHandle triangles{};  // triangle per texel, for a filter that reads or peels them; else {0}
    TriangleReferences references;  // its format, for a filter that reads them
    BoundsTextures sheets;          // conservative map, for a filter of FilterStorage::conservative_bounds
    PrefilterTextures moments;      // prefiltered map, for a filter with FilterRow::moments
    StaticCopy still;               // copy of its static casters, while only some casters move
    MapLayers layers;
    gl::TargetHandle whole{};          // all layers at once; made when first drawn that way
    std::uint64_t wanted_content = 0;  // hash of all layers in the last frame, for lights that may skip their map
    bool waits = false;                // an update of a layer is deferred (QualityLimits::refresh_frames)
    MapAllocation allocation;
    std::uint64_t last_wanted_frame = 0;
    std::uint64_t kept_frame = 0;  // last frame in which its light requested shadows
};

/// Returns the bytes of one layer of a light's map, with its triangles.
std::uint64_t layer_bytes(const CachedMap& map);

/// Returns the bytes of a copy of static casters beside a light's map.
std::uint64_t static_copy_bytes(const CachedMap& map);

/// Describes the target of one layer of a light's map, with its triangles; gl::kAllLayers: of all layers.
gl::TargetDesc target_of(const CachedMap& map, std::int32_t layer);

/// Maps of all lights, and what their layers show. Owns the device objects. With the fit History, all that outlives a
/// frame.
class MapCache {
public:
    explicit MapCache(gl::Device& device) : device_(device) {}
    ~MapCache();
    MapCache(const MapCache&) = delete;
    MapCache& operator=(const MapCache&) = delete;

    /// Counts the frame. Call it first in each frame.
    void begin_frame() { ++frame_; }
    /// Sets the limit on the bytes of maps, valid at any time; kNoLimit: none. Within a limit a map to be enlarged may
    /// be freed before the new one exists, and caches are evicted first.
    void set_limit(std::uint64_t bytes) { limit_ = bytes; }
    static constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};
    /// Sets the bytes of all maps up to which those of unseen lights are kept; kNoLimit: any. Beyond it the least
    /// recently seen are freed before new maps are made.
    void set_keep_limit(std::uint64_t bytes) { keep_limit_ = bytes; }
    /// Lets maps be layers of shared arrays (gl::SharedLayers), one per size and format, so that a few units serve all.
    /// Their edges are then powers of two of at least kLeastSharedEdge_px, but those of ShadowFit::stable, which keep
    /// their size. The bytes of layers that no map uses are not counted. Call it before the first assign().
    void share_layers() { shares_layers_ = true; }
    static constexpr std::uint32_t kLeastSharedEdge_px = 256;
    /// Sets a cache that takes what the limit leaves, and `own_bytes` beside it. It is evicted before any map. It must
    /// outlive this object; null: there is none.
    void set_spare(SpareMemory* spare, std::uint64_t own_bytes) {
        spare_ = spare;
        spare_bytes_ = own_bytes;
    }
    /// Returns the bytes that are left to that cache; kNoLimit: unlimited.
    std::uint64_t room() const {
        return limit_ == kNoLimit ? kNoLimit : limit_ - std::min(limit_, bytes()) + spare_bytes_;
    }
    /// Returns the bytes of all maps when the device last refused one, for kRetryFrames: it has no room for more.
    /// Otherwise kNoLimit.
    std::uint64_t available() const { return frame_ < short_until_frame_ ? available_ : kNoLimit; }

    /// Keeps all maps, in a frame without changes, instead of assign(). Returns false if something is due, as the end
    /// of an unused map or another try; then the stages have to run.
    bool stay();

    /// Gives every view its place, one entry per view; allocates, keeps and frees maps (stage 5). A light loses its map
    /// at once if it has no enabled LightShadow, or if the budget leaves it none. An unseen light loses it after
    /// kHoldFrames. A failed allocation is repeated at half the edge, kHalvings times, and again after kRetryFrames.
    /// Meanwhile the light is unshadowed, or uses rays alone.
    void assign(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const BudgetDecision> decisions,
                std::vector<MapAssignment>& maps, const LightAccounts& accounts);

    /// Returns the number of frames begun.
    std::uint64_t frame() const { return frame_; }
    /// Returns the entry of the light, empty if it has none yet. Valid until the next assign().
    CachedMap& entry(ecs::Entity light);
    /// Makes the copy of static casters beside the light's map. Returns false if the device or the limit has no room.
    /// Then all casters are drawn, as without a copy.
    bool provide_static_copy(CachedMap& map) const;
    /// Returns the bytes of all copies that are worth room (StaticCopy::is_worth_room), made or not.
    std::uint64_t copy_room() const;
    /// Frees copies that were not used for kHoldFrames.
    void release_idle_copies();
    /// Returns the target of all layers at once, {0} where the device refuses.
    gl::TargetHandle whole_target(CachedMap& map) const;
    const gl::DeviceInfo& device() const { return device_.info(); }

    const CachedMap* find(ecs::Entity light) const;
    /// Lists, for each light of the scene, the bytes of its map while a failed allocation is not yet to be tried again;
    /// else empty.
    void waiting_bytes(const SceneSnapshot& scene, std::vector<std::optional<std::uint64_t>>& bytes_of) const;
    std::uint64_t bytes() const;
    static std::uint64_t bytes(const CachedMap& cached);
    /// Returns the same by what it holds.
    static BytesByPart parts(const CachedMap& cached);

    static constexpr std::uint64_t kHoldFrames = 60;  // one second at 60 Hz: looking away and back costs nothing
    static constexpr std::uint64_t kRetryFrames = Retry::kFrames;
    static constexpr std::uint32_t kHalvings = 4;  // down to a sixteenth of the edge; below, a shadow shows nothing

private:
    void note_places(std::size_t first);
    void release(CachedMap& cached);
    bool yield_spare(std::uint64_t bytes_more) const;
    bool make_room(std::uint64_t bytes_more, CachedMap* replaced);
    CachedMap* least_recently_seen();
    void evict_unseen(std::uint64_t wanted_bytes);
    void keep_or_release(ecs::Entity light, Reason skip);
    void provide_maps(const SceneSnapshot& scene, std::span<const BudgetDecision> decisions,
                      const LightAccounts& accounts);
    /// Gives the light a map as requested, or the largest there is room for. Returns false without any. `shrinks`: it
    /// needs no more room than what is cached.
    bool ensure_map(const LightItem& light, const ShadowRequest& request, bool shrinks, CachedMap& cached);
    void release_static_copy(StaticCopy& still) const;
    bool is_copy_idle(const CachedMap& map) const;
    Reason try_create(const gl::TextureDesc& desc, const ShadowRequest& request, CachedMap& cached);
    bool make_targets(CachedMap& map) const;
    Reason make_moments(const ShadowRequest& request, CachedMap& map) const;
    Reason make_sheets(CachedMap& map) const;
    void release_sheets(BoundsTextures& sheets) const;

    gl::Device& device_;
    std::vector<CachedMap> lights_;
    std::unordered_map<std::uint32_t, std::uint32_t> places_;  // into lights_, by the entity's index (any number)
    std::uint64_t frame_ = 0, limit_ = kNoLimit, keep_limit_ = kNoLimit;
    SpareMemory* spare_ = nullptr;
    std::uint64_t spare_bytes_ = 0;
    std::uint64_t available_ = kNoLimit, short_until_frame_ = 0;
    bool shares_layers_ = false;
    bool refused_ = false;  // a map was refused in this frame
};

/// Computes the hash of what a view's layer is to show.
/// `casters`: the view's static casters, view.static_casters in number, then its moving ones. `meshes`: mesh that each
/// is drawn as; empty: its own.
ContentSignature content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                   std::span<const std::uint32_t> casters, std::span<const std::uint32_t> meshes,
                                   CasterFaces faces);

}  // namespace gnomon::shadow
