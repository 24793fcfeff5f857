#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/shadow/frame/budget_decision.h"
#include "systems/shadow/frame/light_accounts.h"
#include "systems/shadow/frame/map_assignment.h"
#include "systems/shadow/frame/shadow_view.h"
#include "systems/shadow/maps/shown_casters.h"
#include "systems/shadow/maps/static_copy.h"
#include "systems/shadow/request/map_textures.h"
#include "systems/spare_memory.h"

namespace gnomon::shadow {

/// A prefiltered map: moments of a depth map's distances, layer by layer, and what its blur needs between its two
/// passes.
struct MomentMap {
    gl::TextureDesc desc{.width = 0}, scratch_desc{.width = 0};  // width 0: there is none
    gl::TextureHandle texture{}, scratch{};
    std::vector<gl::TargetHandle> targets;  // one per layer
    gl::TargetHandle scratch_target{};
    std::vector<std::uint64_t> content;  // per layer, as LightHistory::content
};

/// Beside a depth map of FilterStorage::conservative_bounds (SheetDescs). What each texel shows is
/// LightHistory::triangles.
struct SheetMap {
    gl::TextureHandle second{}, bounds{};  // {0}: there is none
    gl::BufferHandle ends{};               // the same; FilterStorage::occluder_pyramid (occluder_pyramid.h)
    std::vector<gl::TargetHandle> second_targets, bounds_targets;  // one per layer
};

/// What of one light outlives a frame: its map, the targets of its layers, what each layer last held, and when an
/// allocation may be tried again.
struct LightHistory {
    ecs::Entity entity;
    gl::TextureDesc desc;
    gl::TextureHandle texture{};
    FilterStorage storage{};                // what it was made for
    gl::TextureHandle triangles{};          // beside it for a filter that reads or peels triangles; else {0}
    SheetMap sheets;                        // beside it for a filter of FilterStorage::conservative_bounds
    MomentMap moments;                      // beside it for a filter with FilterRow::moments
    StillMap still;                         // beside it while some of its casters move and others do not
    std::vector<gl::TargetHandle> targets;  // one per layer
    gl::TargetHandle whole{};               // all layers at once; made when first drawn that way
    std::uint64_t wanted_content = 0;       // of all layers in the last frame, of lights that may do without a map
    std::vector<std::uint64_t> content;     // per layer: signature of what was drawn, 0: nothing
    std::vector<std::uint64_t> placements;  // per layer: ShadowSlot::placement of it
    std::vector<ShownCasters> shown;        // per layer, of lights whose maps may be kept; else empty
    bool waits = false;                     // one of them shows casters as they were (Grant::refresh_frames)
    std::uint32_t wanted_px = 0;            // size asked for when the map was made
    Reason failure = Reason::none;          // why there is no map, or a smaller one
    std::uint64_t retry_frame = 0;
    std::uint64_t last_wanted_frame = 0;
    std::uint64_t kept_frame = 0;  // in which its light last asked for shadows
};

/// Returns the bytes of one layer of a light's map, with its triangles.
std::uint64_t layer_bytes(const LightHistory& map);

/// What a store of still casters beside a light's map takes.
std::uint64_t still_bytes(const LightHistory& map);

/// One layer of a light's map, with its triangles, or gl::kAllLayers.
gl::TargetDesc target_of(const LightHistory& map, std::int32_t layer);

/// The maps of all lights, and what their layers hold: with the fits' History what outlives a frame. Owns the device
/// objects.
class MapStore {
public:
    explicit MapStore(gl::Device& device) : device_(device) {}
    ~MapStore();
    MapStore(const MapStore&) = delete;
    MapStore& operator=(const MapStore&) = delete;

    /// Counts the frame; to be called once in each, first.
    void begin_frame() { ++frame_; }
    /// The most that maps may hold from now on, at any time; kNoLimit: anything. Within a limit a map that becomes
    /// larger may go before the new one stands, and what only saves time goes first.
    void set_limit(std::uint64_t bytes) { limit_ = bytes; }
    static constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};
    /// Who else holds memory within the limit, and gives it up before any map has to. Outlives this; null: nobody.
    void set_spare(SpareMemory* spare) { spare_ = spare; }
    /// What the limit leaves beside the maps; kNoLimit: anything.
    std::uint64_t room() const { return limit_ == kNoLimit ? kNoLimit : limit_ - std::min(limit_, bytes()); }
    /// For kRetryFrames after the device had no room for a map: what all held then, since more is not to be had;
    /// kNoLimit otherwise.
    std::uint64_t available() const { return frame_ < short_until_frame_ ? available_ : kNoLimit; }

    /// In a frame in which nothing changed, instead of assign_slots(): all stays as it is. False: something is due, as
    /// the end of a map that nobody needs any more, or another try; then the stages have to run.
    bool stay();

    /// Stage 5: gives every view its place, allocating, keeping and freeing maps; one entry per view. A light without
    /// LightShadow, or disabled, or that the budget leaves without shadow, loses its map at once; one that nobody sees
    /// for kHoldFrames later. A failed allocation is tried at half the edge, kHalvings times, then again after
    /// kRetryFrames; meanwhile the light is lit, or uses rays alone.
    void assign(const SceneSnapshot& scene, const FittedViews& fitted, std::span<const BudgetDecision> decisions,
                std::vector<MapAssignment>& maps, const LightAccounts& accounts);

    /// Number of frames begun.
    std::uint64_t frame() const { return frame_; }
    /// Returns what is remembered of the light, an empty entry if nothing is. Holds until the next assign().
    LightHistory& entry(ecs::Entity light);
    /// Makes the copy of static casters beside the light's map. False: there is no room now, in the device or the
    /// limit. Nobody misses it: all is drawn, as without it.
    bool provide_still(LightHistory& map) const;
    /// Frees copies that were not used for kHoldFrames.
    void release_idle_still();
    /// Returns the target of all layers at once, {0} where the device refuses.
    gl::TargetHandle whole_target(LightHistory& map) const;
    const gl::DeviceInfo& device() const { return device_.info(); }

    const LightHistory* find(ecs::Entity light) const;
    /// One per light of the scene: bytes of its map, if that could not be had as it was wanted and it is not yet time
    /// to try again; else empty.
    void waiting_bytes(const SceneSnapshot& scene, std::vector<std::optional<std::uint64_t>>& bytes_of) const;
    std::uint64_t bytes() const;
    static std::uint64_t bytes(const LightHistory& history);

    static constexpr std::uint64_t kHoldFrames = 60;   // one second at 60 Hz: looking away and back costs nothing
    static constexpr std::uint64_t kRetryFrames = 30;  // shadows are back within a second after memory is
    static constexpr std::uint32_t kHalvings = 4;      // down to a sixteenth of the edge; below, a shadow says nothing

private:
    void note_places(std::size_t first);
    void release(LightHistory& history);
    bool yield_spare(std::uint64_t bytes_more) const;
    bool make_room(std::uint64_t bytes_more, LightHistory* replaced);
    void keep_or_release(ecs::Entity light, Reason skip);
    void provide_maps(const SceneSnapshot& scene, std::span<const BudgetDecision> decisions,
                      const LightAccounts& accounts);
    bool ensure_map(const LightItem& light, const ShadowRequest& request, LightHistory& history);
    void release_still(StillMap& still) const;
    bool is_still_idle(const LightHistory& map) const;
    Reason try_create(const gl::TextureDesc& desc, const ShadowRequest& request, LightHistory& history);
    bool make_targets(LightHistory& map) const;
    Reason make_moments(const ShadowRequest& request, LightHistory& map) const;
    Reason make_sheets(LightHistory& map) const;
    void release_sheets(SheetMap& sheets) const;

    gl::Device& device_;
    std::vector<LightHistory> lights_;
    std::unordered_map<std::uint32_t, std::uint32_t> places_;  // in lights_, by the entity's index, which may be any
    std::uint64_t frame_ = 0, limit_ = kNoLimit;
    SpareMemory* spare_ = nullptr;
    std::uint64_t available_ = kNoLimit, short_until_frame_ = 0;
    bool refused_ = false;  // in this frame
};

/// Computes the hash of what a view's layer is to hold.
/// `casters`: view.still_casters that stand still, then those that move.
ContentSignature content_signature(const ShadowView& view, std::uint32_t size_px, const SceneSnapshot& scene,
                                   std::span<const std::uint32_t> casters, CasterFaces faces);

}  // namespace gnomon::shadow
