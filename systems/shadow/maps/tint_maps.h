#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/extract/snapshot.h"
#include "systems/retry.h"
#include "systems/shadow/frame/drawn_views.h"
#include "systems/shadow/frame/tint_assignment.h"

namespace gnomon::shadow {

/// Most texels of one layer over all views of a light: 96 MiB of depths and absorbances. A finer map has its layers at
/// half its edge, or a quarter, since a tint has few edges.
inline constexpr std::uint64_t kMostTintTexels = std::uint64_t{1} << 21;
/// Bytes per texel: four depths, and four absorbances of three channels, and a spare channel each.
inline constexpr std::uint64_t kTintTexelBytes = 16 + std::uint64_t{kTintLayers} * 8;

/// Returns the edge of the layers beside a map of that edge and number of views: the map's, halved until they fit.
std::uint32_t tint_edge_px(std::uint32_t map_edge_px, std::uint32_t views);

/// Returns true if an instance of the mesh is a translucent caster: any of its surfaces transmits light.
bool is_translucent(const GpuScene& gpu, std::uint32_t mesh);

/// Lists the lights with rays that have translucent casters in their sets: 1 for each of these. Empty: there is none.
void list_ray_tints(const SceneSnapshot& scene, const GpuScene& gpu, const DrawnViews& drawn,
                    const ReceiverCasterSets& sets, std::vector<std::uint8_t>& lights);

/// Layers of translucent casters beside the maps of lights that have such casters. Owns the device objects. A scene
/// without such casters has none.
class TintMaps {
public:
    explicit TintMaps(gl::Device& device) : device_(device) {}
    ~TintMaps();
    TintMaps(const TintMaps&) = delete;
    TintMaps& operator=(const TintMaps&) = delete;

    /// Gives each view its layers, one entry per view; empty where nothing is translucent. Allocates, keeps and frees.
    /// `room`: bytes that may be allocated. Without room a light's translucent casters cast nothing, which its status
    /// has as Reason::tint_failed.
    void assign(const SceneSnapshot& scene, const GpuScene& gpu, const DrawnViews& drawn, std::uint64_t room,
                std::span<LightStatus> statuses, std::vector<TintAssignment>& tints);
    /// Returns true if another run of assign() on an unchanged scene would change nothing.
    bool stay() const;
    /// Notes what the layers show after a submission.
    void commit(const SceneSnapshot& scene, const DrawnViews& drawn, std::span<const TintAssignment> tints,
                bool executed);

    /// Returns the bytes of all layers, or of one light's.
    std::uint64_t bytes() const;
    std::uint64_t bytes(ecs::Entity light) const;
    /// Returns the bytes that all lights need, also those without room.
    std::uint64_t wanted_bytes() const { return wanted_bytes_; }

    static constexpr std::uint64_t kHoldFrames = 60;  // as MapCache: looking away and back costs nothing

private:
    struct Layers {
        ecs::Entity light;
        TintTextures textures;
        std::vector<gl::TargetHandle> depths, absorbances;  // one per layer of the map
        std::vector<std::uint64_t> content;                 // per layer of the map; 0: nothing
        std::uint32_t edge_px = 0;
        std::uint64_t wanted_frame = 0;
        Retry retry;
        bool failed = false;
    };
    static std::uint64_t bytes(const Layers& layers);
    Layers& entry(ecs::Entity light);
    Layers* find(ecs::Entity light);
    bool provide(const LightItem& light, std::uint32_t edge_px, std::uint32_t views, std::uint64_t& room,
                 Layers& layers);
    bool create(const LightItem& light, std::uint32_t edge_px, std::uint32_t views, Layers& layers) const;
    void release(Layers& layers) const;
    void release_unused();

    gl::Device& device_;
    std::vector<Layers> lights_;
    std::uint64_t frame_ = 0, wanted_bytes_ = 0;
};

}  // namespace gnomon::shadow
