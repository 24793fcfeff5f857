#include <cmath>
#include <glm/common.hpp>

#include "shaders/bindings.h"
#include "systems/extract/volumes.h"
#include "systems/frame_timers.h"
#include "systems/lighting/mask_pass.h"

/// Surfaces of another renderer's picture, as light passes read them.
namespace gnomon::lighting {
namespace {

constexpr double kUnitRoundoff = 0x1p-24;
constexpr double kNeighbours_px = 2.0;  // pixels around an area that its edges are found from

/// Roundings between an imported depth and its distance, in units of 2^-24 of what is added. They are the rasteriser's
/// interpolation, the format, the offset as a float, the sum and the quotient.
constexpr double kImportRoundings = 5.0;

/// Errors of imported distances, as CameraRecord::lens.zw: per metre and per square metre (perspective), or metres
/// (orthographic).
glm::dvec2 import_errors(const PictureLens& lens, const DepthRounding& rounding) {
    const double scale = std::abs(lens.scale);
    const double rounded = kImportRoundings * kUnitRoundoff;
    if (lens.orthographic) return {scale * (rounding.step + rounded) + rounded * std::abs(lens.offset), 0.0};
    // d(distance) = distance^2 / scale * d(depth); a depth is scale / distance - offset.
    return {rounded, (rounding.step + 2.0 * rounded * std::abs(lens.offset)) / scale};
}

}  // namespace

shadow::CameraRecord with_lens(const shadow::CameraRecord& camera, const DepthPicture& picture) {
    const PictureLens& lens = picture.lens;
    shadow::CameraRecord record = camera;
    record.right.w = static_cast<float>(lens.half.x);
    record.up.w = static_cast<float>(lens.half.y);
    record.unproject.z = static_cast<float>(picture.size_px.x);
    record.unproject.w = static_cast<float>(picture.size_px.y);
    record.lens = glm::vec4(glm::vec2(lens.shift), glm::vec2(import_errors(lens, picture.rounding)));
    return record;
}

gl::Rect in_picture(const gl::Rect& area, const ConsumerItem& consumer, const DepthPicture& picture) {
    const glm::dvec2 half = half_extent(consumer), size(picture.size_px);
    const auto pixels = [&](const glm::dvec2& of_consumer) {
        const glm::dvec2 place = (of_consumer / glm::dvec2(consumer.viewport_px) * 2.0 - 1.0) * half;
        return (place / picture.lens.half - picture.lens.shift + 1.0) * 0.5 * size;
    };
    const glm::dvec2 low(area.x, area.y), high = low + glm::dvec2(area.width, area.height);
    const glm::dvec2 from = glm::clamp(glm::floor(pixels(low)), glm::dvec2(0.0), size);
    const glm::dvec2 to = glm::clamp(glm::ceil(pixels(high)), glm::dvec2(0.0), size);
    if (!(from.x < to.x && from.y < to.y)) return {};
    return {static_cast<std::int32_t>(from.x), static_cast<std::int32_t>(from.y),
            static_cast<std::int32_t>(to.x - from.x), static_cast<std::int32_t>(to.y - from.y)};
}

gl::Rect masked_area(const shadow::LitArea& area, const DepthPicture& picture) {
    return picture.shows_only_added ? area.screen : area.reach;
}

float masked_depth(const shadow::LitArea& area, const DepthPicture& picture) {
    return picture.shows_only_added ? area.farthest_depth : area.reach_depth;
}

gl::Rect reached_pixels(const MaskInputs& in) {
    const ConsumerItem& consumer = in.scene.consumers[in.inputs.consumer];
    glm::dvec2 low(in.picture.size_px), high(0.0);
    for (const std::uint32_t layer : in.layers) {
        if (layer >= in.inputs.lights.size()) continue;
        const gl::Rect area = in_picture(masked_area(in.inputs.lights[layer].area, in.picture), consumer, in.picture);
        if (area.width == 0) continue;
        low = glm::min(low, glm::dvec2(area.x, area.y) - kNeighbours_px);
        high = glm::max(high, glm::dvec2(area.x + area.width, area.y + area.height) + kNeighbours_px);
    }
    low = glm::max(low, 0.0);
    high = glm::min(high, glm::dvec2(in.picture.size_px));
    if (!(low.x < high.x && low.y < high.y)) return {};
    return {static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y),
            static_cast<std::int32_t>(high.x - low.x), static_cast<std::int32_t>(high.y - low.y)};
}

gl::ProgramHandle MaskPass::import_program(const DepthPicture& picture) const {
    return programs_.import_surfaces(!picture.samples.empty(), static_cast<bool>(picture.normals));
}

/// Records what light passes read of each surface's material, which is the same for all: the layers that it takes
/// shadows of.
void MaskPass::import_material(const DepthPicture& picture, gl::CommandList& list) const {
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
    const float layers = static_cast<float>(picture.receive_layers) / 255.0f;
    list.add(gl::BeginPass{same_material_, all, false, 0.0f, true, {0.0f, 0.0f, layers, 0.0f}});
    list.add(gl::EndPass{});
}

/// Records the surfaces of one sample, as light passes read them, where lights reach: elsewhere there are none.
void MaskPass::import(const DepthPicture& picture, const gl::Rect& area, std::uint32_t sample,
                      gl::CommandList& list) const {
    const gl::Rect all{0, 0, static_cast<std::int32_t>(size_px_.x), static_cast<std::int32_t>(size_px_.y)};
    list.add(gl::BeginGroup{"imported surfaces"});
    list.add(gl::BeginTimer{kSurfaceTimer});
    // What no surface is drawn over has no depth, and its normals are not read.
    list.add(gl::BeginPass{surfaces_, all, true, 0.0f, false, {}});
    list.add(gl::SetScissor{area});
    list.add(gl::SetPipeline{
        {import_program(picture), gl::CullMode::none, false, gl::DepthTest::greater, true, false, gl::Blend::off}});
    bind_camera(sample, list);
    list.add(gl::BindUniforms{bindings::kImportBlock, uniforms_.handle(), sample * sample_stride_ + import_offset_,
                              sizeof(ImportRecord)});
    list.add(gl::BindTexture{bindings::kImportedDepthUnit, picture.depth, sampler_});
    list.add(
        gl::BindTexture{bindings::kImportedNormalUnit, picture.normals ? picture.normals : picture.depth, sampler_});
    if (area.width > 0) list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    list.add(gl::EndTimer{kSurfaceTimer});
    list.add(gl::EndGroup{});
}

}  // namespace gnomon::lighting
