#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/gl/device.h"
#include "systems/retry.h"
#include "systems/spare_memory.h"

namespace gnomon::lighting {

/// What the pixels of a picture saw of its lights in an earlier frame, so that lights need not be looked up while
/// nothing that this follows from changes: one texture per camera and light, a float per pixel that the light can
/// reach. Owns its device objects. Scenes that move have none.
///
/// For each picture: begin(), plan() for each light that may be kept, end(). After the submission: submitted().
class KeptVisibility final : public SpareMemory {
public:
    explicit KeptVisibility(gl::Device& device) : device_(device) {}
    ~KeptVisibility();
    KeptVisibility(const KeptVisibility&) = delete;
    KeptVisibility& operator=(const KeptVisibility&) = delete;

    /// A picture of `camera`; `most_bytes`: all that may be held.
    void begin(ecs::Entity camera, std::uint64_t most_bytes);

    enum class Use : std::uint8_t {
        look_up,  // as without this
        fill,     // looked up once more, into the texture, and read from there
        read
    };
    struct Plan {
        Use use = Use::look_up;
        gl::Rect area{};              // of the picture, which `texture` holds
        gl::TextureHandle texture{};  // r32f
        gl::TargetHandle target{};    // of it
        /// Of the size of the picture, where the area is less: to be filled instead and then copied; else {0}.
        gl::TargetHandle scratch{};
        std::uint64_t bytes = 0;
    };
    /// `signature`: of all that the light's visibility in this picture follows from; 0: it is not to be kept. Filled is
    /// in the second frame in which it is what it was, so that what moves on pays nothing.
    Plan plan(ecs::Entity light, std::uint64_t signature, gl::Rect area, glm::uvec2 picture_px);
    /// What plan() said last of that light cannot be done, for want of a program.
    void cancel(ecs::Entity light);
    /// Frees what no light of this picture asked for, and what has not been read for kHoldFrames.
    void end();
    /// What was recorded since the last call was executed, or not: then nothing of it, nor before it, is trusted.
    /// Until it is first called nothing is kept: nobody would say so.
    void submitted(bool drawn);
    bool is_told() const { return is_told_; }

    std::uint64_t bytes() const override;
    void release() override;
    /// Whether the texture that a plan named still stands.
    bool holds(gl::TextureHandle texture) const;

    static constexpr std::uint64_t kHoldFrames = 60;  // of a camera: a second at 60 Hz, as maps (MapStore)
    static constexpr std::uint32_t kStillFrames = 2;  // as they were, before it pays

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
        std::uint64_t asked_picture = 0, read_picture = 0;
        Retry retry;  // of allocations, in pictures
    };
    Entry& entry(ecs::Entity light);
    bool provide(Entry& entry, gl::Rect area, glm::uvec2 picture_px);
    bool provide_scratch(glm::uvec2 picture_px);
    bool make(const char* label, glm::uvec2 size_px, gl::TextureHandle& texture, gl::TargetHandle& target);
    void free(Entry& entry);
    void free_scratch();

    gl::Device& device_;
    std::vector<Entry> entries_;
    std::size_t next_ = 0;  // where the next light asked for is likely to be
    gl::TextureHandle scratch_{};
    gl::TargetHandle scratch_target_{};
    glm::uvec2 scratch_px_{0, 0};
    ecs::Entity camera_;
    std::uint64_t picture_ = 0, most_bytes_ = 0;
    bool is_told_ = false;
};

}  // namespace gnomon::lighting
