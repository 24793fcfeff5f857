#include "systems/lighting/kept_visibility.h"

#include <algorithm>

namespace gnomon::lighting {
namespace {

constexpr gl::Format kFormat = gl::Format::r32f;  // the shaders' own precision, so that nothing is lost

glm::uvec2 size_of(gl::Rect area) { return {area.width, area.height}; }

std::uint64_t bytes_of(glm::uvec2 size_px) { return std::uint64_t{size_px.x} * size_px.y * gl::texel_bytes(kFormat); }

bool is_whole(gl::Rect area, glm::uvec2 picture_px) {
    return area.x == 0 && area.y == 0 && size_of(area) == picture_px;
}

}  // namespace

KeptVisibility::~KeptVisibility() { release(); }

void KeptVisibility::begin(ecs::Entity camera, std::uint64_t most_bytes) {
    camera_ = camera;
    most_bytes_ = most_bytes;
    next_ = 0;
    scratch_bytes_ = 0;
    ++picture_;
    free_scratch();
    if (bytes() > most_bytes) release();
}

KeptVisibility::Entry& KeptVisibility::entry(ecs::Entity light) {
    // Lights come in the same order in every picture of a camera.
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const std::size_t at = next_ + i < entries_.size() ? next_ + i : next_ + i - entries_.size();
        if (entries_[at].light != light || entries_[at].camera != camera_) continue;
        next_ = at + 1;
        return entries_[at];
    }
    next_ = entries_.size() + 1;
    Entry& made = entries_.emplace_back();
    made.camera = camera_;
    made.light = light;
    return made;
}

KeptVisibility::Plan KeptVisibility::plan(ecs::Entity light, std::uint64_t signature, gl::Rect area,
                                          glm::uvec2 picture_px) {
    if (signature == 0) return {};
    Entry& kept = entry(light);
    kept.requested_picture = picture_;
    kept.wanted_bytes = bytes_of(size_of(area));
    if (!is_whole(area, picture_px)) scratch_bytes_ = bytes_of(picture_px);
    if (kept.signature != signature) {
        kept.signature = signature;
        kept.still_frames = 0;
        kept.content = Content::none;
        return {};
    }
    kept.still_frames = std::min(kept.still_frames + 1, kStaticFrames);
    Use use = Use::read;
    if (kept.content != Content::stands) {
        const bool fills = kept.content == Content::none && kept.still_frames == kStaticFrames && is_told_;
        if (!fills || !provide(kept, area, picture_px)) return {};
        kept.content = Content::recorded;
        use = Use::fill;
    }
    kept.read_picture = picture_;
    const bool scratch = use == Use::fill && !is_whole(area, picture_px);
    return {
        use, area, kept.texture, kept.target, scratch ? scratch_target_ : gl::TargetHandle{}, bytes_of(size_of(area))};
}

void KeptVisibility::cancel(ecs::Entity light) {
    Entry& kept = entry(light);
    kept.content = Content::none;
    kept.still_frames = 0;
}

bool KeptVisibility::provide(Entry& kept, gl::Rect area, glm::uvec2 picture_px) {
    const bool whole = is_whole(area, picture_px);
    if (kept.texture && size_of(kept.area) == size_of(area) && (whole || provide_scratch(picture_px))) {
        kept.area = area;
        return true;
    }
    free(kept);
    const std::uint64_t scratch_bytes = whole || scratch_ ? 0 : bytes_of(picture_px);
    const std::uint64_t more = bytes_of(size_of(area)) + scratch_bytes, taken = bytes();
    if (taken > most_bytes_ || more > most_bytes_ - taken || !kept.retry.due(picture_)) return false;
    if (make("kept visibility", size_of(area), kept.texture, kept.target) && (whole || provide_scratch(picture_px))) {
        kept.area = area;
        return true;
    }
    free(kept);
    kept.retry.failed(picture_);
    return false;
}

bool KeptVisibility::provide_scratch(glm::uvec2 picture_px) {
    if (scratch_ && scratch_px_ == picture_px) return true;
    free_scratch();
    if (bytes() + bytes_of(picture_px) > most_bytes_) return false;
    if (!make("kept visibility, scratch", picture_px, scratch_, scratch_target_)) return false;
    scratch_px_ = picture_px;
    return true;
}

bool KeptVisibility::make(const char* label, glm::uvec2 size_px, gl::TextureHandle& texture, gl::TargetHandle& target) {
    texture = device_.create_texture({label, gl::TextureKind::flat, kFormat, size_px.x, size_px.y}, {}).handle;
    if (texture) target = device_.create_target({label, {{texture, -1}}, {}}).handle;
    if (target) return true;
    device_.destroy(texture);
    texture = {};
    return false;
}

void KeptVisibility::free(Entry& kept) {
    if (!kept.texture) return;
    device_.destroy(kept.target);
    device_.destroy(kept.texture);
    kept.target = {};
    kept.texture = {};
    kept.content = Content::none;
}

void KeptVisibility::free_scratch() {
    device_.destroy(scratch_target_);
    device_.destroy(scratch_);
    scratch_target_ = {};
    scratch_ = {};
    scratch_px_ = {0, 0};
}

void KeptVisibility::end() {
    const auto is_over = [&](Entry& kept) {
        const bool gone = kept.camera == camera_ ? kept.requested_picture != picture_
                                                 : picture_ - kept.requested_picture > kHoldFrames;
        if (gone || picture_ - kept.read_picture > kHoldFrames) free(kept);
        return gone;
    };
    std::erase_if(entries_, is_over);
}

void KeptVisibility::submitted(bool drawn) {
    is_told_ = true;
    free_scratch();
    for (Entry& kept : entries_) {
        if (!drawn) kept.content = Content::none;
        if (kept.content == Content::recorded) kept.content = Content::stands;
    }
}

std::uint64_t KeptVisibility::bytes() const {
    std::uint64_t sum = bytes_of(scratch_px_);
    for (const Entry& kept : entries_)
        if (kept.texture) sum += bytes_of(size_of(kept.area));
    return sum;
}

std::uint64_t KeptVisibility::wanted_bytes() const {
    std::uint64_t sum = scratch_bytes_;
    for (const Entry& kept : entries_) sum += kept.wanted_bytes;
    return sum;
}

void KeptVisibility::release() {
    for (Entry& kept : entries_) free(kept);
    free_scratch();
}

bool KeptVisibility::holds(gl::TextureHandle texture) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& kept) { return kept.texture == texture; });
}

}  // namespace gnomon::lighting
