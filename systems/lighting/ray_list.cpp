#include "systems/lighting/ray_list.h"

#include "shaders/bindings.h"

#include <algorithm>
#include <bit>
#include <span>

namespace gnomon::lighting {
namespace {

constexpr std::uint64_t kWord = sizeof(std::uint32_t);
/// Number of vertices of two triangles.
constexpr std::uint32_t kQuadVertices = 6;

/// Block in shaders/lighting/trace/ray_list_layout.glsl.
constexpr glm::uvec2 kListBlock{4, 2};

gl::Rect area_of(glm::uvec2 size_px) {
    return {0, 0, static_cast<std::int32_t>(size_px.x), static_cast<std::int32_t>(size_px.y)};
}

}  // namespace

glm::uvec2 ray_list_size_px(glm::uvec2 picture_px) {
    const std::uint32_t places = picture_px.x * picture_px.y;
    const std::uint32_t width = std::max(1u << std::bit_width(places) / 2, kListBlock.x);
    const std::uint32_t in_rows = width * kListBlock.y;
    return {width, (places + in_rows - 1) / in_rows * kListBlock.y};
}

RayList::RayList(gl::Device& device) : device_(device) {}

void RayList::release() {
    for (gl::TargetHandle* target : {&verdict_target_, &answer_target_}) {
        device_.destroy(*target);
        *target = {};
    }
    for (gl::TextureHandle* texture : {&verdicts_, &answers_}) {
        device_.destroy(*texture);
        *texture = {};
    }
    device_.destroy(pixels_);
    pixels_ = {};
    bytes_ = 0;
}

bool RayList::make(glm::uvec2 size_px, gl::TextureHandle depth) {
    size_px_ = size_px;
    depth_ = depth;
    const auto texture = [&](const char* label, gl::Format format, glm::uvec2 size) {
        bytes_ += std::uint64_t{gl::texel_bytes(format)} * size.x * size.y;
        return device_.create_texture({label, gl::TextureKind::flat, format, size.x, size.y}, {}).handle;
    };
    const std::uint64_t words = 1 + std::uint64_t{size_px.x} * size_px.y;
    bytes_ = words * kWord;
    verdicts_ = texture("verdicts of maps", gl::Format::r32ui, size_px);
    if (verdicts_) answers_ = texture("answers of rays", gl::Format::r8, ray_list_size_px(size_px));
    if (answers_)
        pixels_ = device_.create_buffer({"pixels for rays", words * kWord, gl::BufferUse::updated}, {}).handle;
    if (!pixels_) return false;
    verdict_target_ = device_.create_target({"verdicts of maps", {{verdicts_}}, {depth}}).handle;
    if (verdict_target_) answer_target_ = device_.create_target({"answers of rays", {{answers_}}, {}}).handle;
    return static_cast<bool>(answer_target_);
}

bool RayList::provide(bool wanted, glm::uvec2 size_px, gl::TextureHandle depth) {
    if (wanted && answer_target_ && size_px == size_px_ && depth == depth_) return true;
    release();
    if (!wanted) return true;
    if (!retry_.due(++calls_)) return false;
    if (make(size_px, depth)) return true;
    release();
    retry_.failed(calls_);
    return false;
}

void RayList::begin_verdicts(gl::CommandList& list) const {
    list.add(gl::ClearBuffer{pixels_, 0, kWord});
    list.add(gl::BindStorage{bindings::kRayListBuffer, pixels_});
    list.add(gl::BeginPass{verdict_target_, area_of(size_px_), false, 0.0f, false, {}});
}

void RayList::end_verdicts(gl::CommandList& list) const { list.add(gl::EndPass{.wrote_storage = true}); }

void RayList::record_rays(gl::ProgramHandle program, gl::CommandList& list) const {
    list.add(gl::BeginPass{answer_target_, area_of(ray_list_size_px(size_px_)), false, 0.0f, false, {}});
    list.add(gl::SetPipeline{{program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    list.add(gl::DrawPulled{0, kQuadVertices});
    list.add(gl::EndPass{});
}

void RayList::bind_answers(gl::CommandList& list) const {
    list.add(gl::BindTexture{bindings::kVerdictUnit, verdicts_, {}});
    list.add(gl::BindTexture{bindings::kAnswerUnit, answers_, {}});
}

void RayList::unbind_answers(gl::CommandList& list) const {
    list.add(gl::BindTexture{bindings::kVerdictUnit, {}, {}});
    list.add(gl::BindTexture{bindings::kAnswerUnit, {}, {}});
}

}  // namespace gnomon::lighting
