#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/commands.h"
#include "engine/gl/device.h"
#include "systems/extract/gpu_scene.h"
#include "systems/growing_buffer.h"
#include "systems/lookup/lookup_record.h"
#include "systems/lookup/lookup_rows.h"
#include "systems/shadow/frame/lighting_inputs.h"

namespace gnomon::lookup {

/// How the text looks a light up.
enum class LookupStatus : std::uint8_t {
    own_filter,      // as by its own row
    nearest_filter,  // with another filter, as the text has not its own
    unshadowed,      // it has no shadow in this frame: lit
    rays_alone,      // it has no map, only rays: lit; a mask has its shadow
    not_shared,      // its map lies in no shared array (ShadowSystem::share_layers()): lit
    no_row,          // the text has no row for its kind, or only filters that its map does not serve: lit
    no_unit          // the text has too few texture units for its array: lit; a mask has its shadow
};
/// Returns one sentence on it.
const char* to_text(LookupStatus status);

struct LookupOutcome {
    LookupStatus status = LookupStatus::unshadowed;
    ShadowFilter filter = ShadowFilter::automatic;  // filter of the text that looks it up; automatic: none
    bool operator==(const LookupOutcome&) const = default;
};

/// A shared array at a unit, and a buffer as texels or as storage.
struct LookupTexture {
    std::uint32_t unit = 0;
    gl::TextureHandle texture{};
    gl::SamplerHandle sampler{};
};
struct LookupTexels {
    std::uint32_t unit = 0;
    gl::BufferHandle buffer{};
};
struct LookupStorage {
    std::uint32_t binding = 0;
    gl::BufferHandle buffer{};
};

/// Records of all lights of one camera's view for the text of lookup_glsl(), and what to bind for it. The text's
/// program may stay bound: only bindings change. Owns its buffer.
class LookupTable {
public:
    /// Creates no buffer yet. `bindings` and `rows`: as the text has them.
    LookupTable(gl::Device& device, const LookupBindings& bindings, const LookupRows& rows = {});
    ~LookupTable();
    LookupTable(const LookupTable&) = delete;
    LookupTable& operator=(const LookupTable&) = delete;

    /// Writes the records of the lights of `inputs`, light by light, and records their upload if they changed. Call it
    /// after ShadowSystem::update(), before the list is submitted. Returns false if the device has no room: the text
    /// must not be used then. Allocates nothing once its lists have grown.
    bool update(const shadow::LightingInputs& inputs, const GpuScene& gpu, gl::CommandList& list,
                std::uint32_t noise_round = 0);
    /// Makes the next update() upload all. Call it after a failed submission.
    void forget_upload() { uploaded_.clear(); }

    /// Returns one entry per light of the last update().
    std::span<const LookupOutcome> outcomes() const { return outcomes_; }

    /// Returns what to bind after the last update(), for engines that call OpenGL themselves. gl::gl_name() and
    /// gl::gl_texels_name() give OpenGL's names.
    std::span<const LookupTexture> textures() const { return textures_; }
    std::span<const LookupTexels> texels() const { return texels_; }
    std::span<const LookupStorage> storage() const { return storage_; }
    /// Records the same as commands.
    void bind(gl::CommandList& list) const;

private:
    /// Array of depths at a unit, and at the unit beside it the array of triangles that its texels show. They keep it
    /// while any light needs them.
    struct Unit {
        gl::TextureHandle depths{}, triangles{};
        bool reads_depths = false, reads_triangles = false;  // in this frame
    };
    struct Found {
        gl::SharedLayers depths, triangles;
        FilterChoice choice;
        LookupOutcome outcome;
        float reach_texel = 0.0f;
    };
    Found find(const shadow::LightingLight& light) const;
    void write(const shadow::LightingLight& light, const Found& found, LookupOutcome& outcome, LookupRecord& record);
    bool provide_objects();
    void keep_units();
    int take_unit(gl::TextureHandle depths, gl::TextureHandle triangles);
    void list_bindings(const GpuScene& gpu);

    gl::Device& device_;
    LookupBindings bindings_;
    std::vector<ShadowFilter> filters_;
    LookupRows rows_;  // its filters are filters_
    std::vector<Unit> units_;
    gl::SamplerHandle sampler_{};
    gl::TextureHandle no_depths_{}, no_triangles_{};  // at units without an array: drivers want a texture at each
    GrowingBuffer buffer_;
    std::vector<Found> found_;
    std::vector<std::byte> bytes_, uploaded_;
    std::vector<LookupOutcome> outcomes_;
    std::vector<LookupTexture> textures_;
    std::vector<LookupTexels> texels_;
    std::vector<LookupStorage> storage_;
};

}  // namespace gnomon::lookup
