#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/gl/device.h"
#include "gnomon/components.h"
#include "systems/retry.h"
#include "systems/spare_memory.h"

namespace gnomon::lighting {

/// Cache of lights' visibility per pixel, from an earlier frame, for pictures in which none of its inputs changes. A
/// texture per camera and light, with a float per pixel that the light can reach. Owns its device objects. Moving
/// scenes use no memory.
/// For each picture: begin(), plan() for each cacheable light, end(). After the submission: submitted().
class KeptVisibility final : public SpareMemory {
public:
    explicit KeptVisibility(gl::Device& device) : device_(device) {}
    ~KeptVisibility();
    KeptVisibility(const KeptVisibility&) = delete;
    KeptVisibility& operator=(const KeptVisibility&) = delete;

    /// Starts a picture of `camera`. `most_bytes`: limit for all textures.
    void begin(ecs::Entity camera, std::uint64_t most_bytes);

    enum class Use : std::uint8_t {
        look_up,  // as without a cache
        fill,     // look up once more, into the texture, and read from there
        read
    };
    struct Plan {
        Use use = Use::look_up;
        gl::Rect area{};              // part of the picture in `texture`
        gl::TextureHandle texture{};  // r32f
        gl::TargetHandle target{};    // target of `texture`
        /// Texture of the picture's size, if the area is smaller: fill it, then copy the area. Otherwise {0}.
        gl::TargetHandle scratch{};
        std::uint64_t bytes = 0;
    };
    /// Decides what to do for a light. `signature`: hash of all inputs of the light's visibility in this picture; 0: do
    /// not cache. Fills in the second frame with equal signatures, so that moving scenes pay nothing.
    Plan plan(ecs::Entity light, std::uint64_t signature, gl::Rect area, glm::uvec2 picture_px);
    /// Cancels the last plan of that light, for lack of a program.
    void cancel(ecs::Entity light);
    /// Frees the textures that no light of this picture used, and all not read for kHoldFrames.
    void end();
    /// Reports that everything recorded since the last call was executed, or failed; after a failure no content is
    /// trusted. Nothing is cached before the first call, because results would be unknown.
    void submitted(bool drawn);
    bool is_told() const { return is_told_; }

    std::uint64_t bytes() const override;
    /// Returns the bytes for all lights of the last pictures that may be cached, the scratch of one included.
    std::uint64_t wanted_bytes() const override;
    void release() override;
    /// Returns true if the texture of a plan still exists.
    bool holds(gl::TextureHandle texture) const;

    static constexpr std::uint64_t kHoldFrames = 60;   // frames of a camera: a second at 60 Hz, as for maps (MapCache)
    static constexpr std::uint32_t kStaticFrames = 2;  // unchanged frames before caching pays

private:
    enum class Content : std::uint8_t { none, recorded, stands };
    struct Entry {
        ecs::Entity camera, light;
        std::uint64_t signature = 0;
        std::uint32_t still_frames = 0;
        Content content = Content::none;
        gl::Rect area{};
        gl::TextureHandle texture{};
        gl::TargetHandle target{};
        std::uint64_t wanted_bytes = 0;
        std::uint64_t requested_picture = 0, read_picture = 0;
        Retry retry;  // for allocations, in pictures
    };
    Entry& entry(ecs::Entity light);
    bool provide(Entry& entry, gl::Rect area, glm::uvec2 picture_px);
    bool provide_scratch(glm::uvec2 picture_px);
    bool make(const char* label, glm::uvec2 size_px, gl::TextureHandle& texture, gl::TargetHandle& target);
    void free(Entry& entry);
    void free_scratch();

    gl::Device& device_;
    std::vector<Entry> entries_;
    std::size_t next_ = 0;  // probable index of the next light
    gl::TextureHandle scratch_{};
    gl::TargetHandle scratch_target_{};
    glm::uvec2 scratch_px_{0, 0};
    ecs::Entity camera_;
    std::uint64_t picture_ = 0, most_bytes_ = 0;
    std::uint64_t scratch_bytes_ = 0;  // texture of the last picture, if some light does not cover it
    bool is_told_ = false;
};

}  // namespace gnomon::lighting
