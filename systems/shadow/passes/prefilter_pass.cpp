#include "systems/shadow/passes/prefilter_pass.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/frame_timers.h"
#include "systems/shadow/frame/cpu_timer.h"
#include "systems/shadow/projection/cube_faces.h"
#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "systems/shadow/request/map_textures.h"
#include "systems/shadow/request/prefilter_settings.h"

namespace gnomon::shadow {
namespace {

/// Distance of a corner of a cube's far plane over that of its middle
/// (shaders/shadow/passes/prefilter/linear_distance.glsl).
constexpr double kCubeCorner = 1.7320508075688772;

bool is_cube(const ShadowView& view) { return view.projection == ViewProjection::cube_face; }

bool is_converted(const DrawnViews& drawn, std::size_t v) {
    return drawn.updates[v].convert && drawn.has_prefiltered(v);
}

/// Returns a mask with one bit per face of the light's cube that has a view with a map.
std::int32_t faces_of(const DrawnViews& drawn, std::uint32_t light) {
    const IndexRange range = drawn.fitted.lights[light].views;
    std::int32_t faces = 0;
    for (std::size_t v = range.first; v < range.end(); ++v)
        if (drawn.has_map(v)) faces |= 1 << drawn.view(v).layer;
    return faces;
}

void draw_whole(gl::TargetHandle target, std::uint32_t width, std::uint32_t height, gl::ProgramHandle program,
                gl::TextureHandle source, gl::CommandList& list) {
    const gl::Rect whole{0, 0, static_cast<std::int32_t>(width), static_cast<std::int32_t>(height)};
    list.add(gl::BeginPass{target, whole, false, 0.0f, false, {}});
    list.add(gl::SetPipeline{{program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    list.add(gl::BindTexture{bindings::kPrefilterSourceUnit, source, {}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
}

}  // namespace

MomentRecord moment_record(const MapSettings& map, const ShadowView& view, std::int32_t faces) {
    MomentRecord record;
    record.settings = map.moments.settings;
    const double farthest_m = view.depth.far_m * (is_cube(view) ? kCubeCorner : 1.0);
    record.range = {static_cast<float>(view.depth.alpha), static_cast<float>(view.depth.beta),
                    static_cast<float>(view.depth.near_m), static_cast<float>(1.0 / (farthest_m - view.depth.near_m))};
    record.place = {static_cast<std::int32_t>(view.layer), static_cast<std::int32_t>(map.filtering.size / 2),
                    static_cast<std::int32_t>(scratch_rows(map, is_cube(view))), faces};
    if (is_cube(view)) {
        const CubeFace& face = cube_face(view.layer);
        record.axis_u = glm::vec4(glm::vec3(face.axis_u), 0.0f);
        record.axis_v = glm::vec4(glm::vec3(face.axis_v), 0.0f);
        record.axis_back = glm::vec4(glm::vec3(face.axis_back), 0.0f);
    }
    const auto weights = blur_weights(map.filtering.size);
    static_assert(sizeof record.weights == sizeof weights);
    std::memcpy(record.weights, weights.data(), sizeof weights);
    return record;
}

PrefilterPass::~PrefilterPass() {
    for (const Program& p : programs_) device_.destroy(p.program);
}

PrefilterPass::Source PrefilterPass::source_of(const ShadowView& view) {
    if (is_cube(view)) return Source::cube;
    return view.projection == ViewProjection::perspective ? Source::perspective : Source::orthographic;
}

gl::ProgramHandle PrefilterPass::program(std::string_view filter_file, Source source) {
    auto found = std::find_if(programs_.begin(), programs_.end(),
                              [&](const Program& p) { return p.filter_file == filter_file && p.source == source; });
    if (found == programs_.end()) found = programs_.insert(programs_.end(), {filter_file, source, {}, {}});
    if (found->program || !found->retry.due(frame_)) return found->program;
    const std::string row = filter_file.empty() ? std::string() : "#include \"" + std::string(filter_file) + "\"\n";
    std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
    files.push_back({"row.glsl", row});
    std::vector<std::string> defines;
    if (source == Source::cube) defines.emplace_back("CUBE 1");
    if (source == Source::perspective) defines.emplace_back("PERSPECTIVE 1");
    const char* const file =
        source == Source::scratch ? "shadow/passes/prefilter/blur.frag" : "shadow/passes/prefilter/from_depth.frag";
    const auto vertex = gl::expand_shader(files, "common/fullscreen.vert", {});
    const auto fragment = gl::expand_shader(files, file, defines);
    if (vertex && fragment) {
        std::string label = source == Source::scratch ? "moments blur" : "moments " + std::string(filter_file);
        for (const std::string& define : defines) label += ' ' + define;
        found->program = device_.create_program({label, vertex.value(), fragment.value()}).handle;
    }
    if (!found->program) found->retry.failed(frame_);
    return found->program;
}

bool PrefilterPass::ready(const DrawnViews& drawn, std::size_t v) {
    return program(filter_row(drawn.request_of(v).map.filter).file, source_of(drawn.view(v))) &&
           (!drawn.maps[v].prefiltered.scratch || program({}, Source::scratch));
}

void PrefilterPass::prepare(const PassInputs& in, const LightAccounts& accounts) {
    ++frame_;
    std::size_t count = 0;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!is_converted(in.drawn, v)) continue;
        const std::uint32_t light = in.drawn.view(v).light;
        const LightTimer time(accounts.cpu_us, light);
        if (ready(in.drawn, v))
            ++count;
        else
            accounts.statuses[light].lose_prefiltered(Reason::filter_program_failed);
    }
    if (count == 0 || records_.reserve(count * aligned(sizeof(MomentRecord), device_.info().uniform_alignment))) return;
    for (std::size_t v = 0; v < in.drawn.count(); ++v)
        if (is_converted(in.drawn, v))
            accounts.statuses[in.drawn.view(v).light].lose_maps(Reason::buffer_failed, false);
}

void PrefilterPass::record_view(const PassInputs& in, std::size_t v, std::uint32_t offset, gl::CommandList& list) {
    const ShadowView& view = in.drawn.view(v);
    const MapAssignment& map = in.drawn.maps[v];
    const MapSettings& settings = in.drawn.request_of(v).map;
    list.add(gl::BeginGroup{{"moments", in.scene.lights[view.light].name, std::to_string(view.layer)}});
    list.add(gl::BeginTimer{shadow_timer(view.light)});
    list.add(gl::BindUniforms{bindings::kPrefilterBlock, records_.handle(), offset, sizeof(MomentRecord)});
    const gl::ProgramHandle first = program(filter_row(settings.filter).file, source_of(view));
    const PrefilteredMaps& made = map.prefiltered;
    if (made.scratch) {
        const std::uint32_t rows = map.size_px + 2 * scratch_rows(settings, is_cube(view));
        draw_whole(made.scratch_target, map.size_px, rows, first, map.texture, list);
        draw_whole(made.target, map.size_px, map.size_px, program({}, Source::scratch), made.scratch, list);
    } else {
        draw_whole(made.target, map.size_px, map.size_px, first, map.texture, list);
    }
    bool last = true;
    for (std::size_t next = v + 1; next < in.drawn.fitted.lights[view.light].views.end(); ++next)
        last = last && !is_converted(in.drawn, next);
    if (last && settings.moments.levels > 1) list.add(gl::GenerateMips{made.moments});
    list.add(gl::EndTimer{shadow_timer(view.light)});
    list.add(gl::EndGroup{});
}

void PrefilterPass::record(const PassInputs& in, const PassOutputs& out) {
    const std::uint32_t stride = aligned(sizeof(MomentRecord), device_.info().uniform_alignment);
    record_scratch_.clear();
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!is_converted(in.drawn, v)) continue;
        const ShadowView& view = in.drawn.view(v);
        const std::int32_t faces = is_cube(view) ? faces_of(in.drawn, view.light) : 0;
        const MomentRecord record = moment_record(in.drawn.request_of(v).map, view, faces);
        const std::size_t at = record_scratch_.size();
        record_scratch_.resize(at + stride);
        std::memcpy(record_scratch_.data() + at, &record, sizeof record);
    }
    if (record_scratch_.empty()) return;
    out.list.update(records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    std::uint32_t offset = 0;
    for (std::size_t v = 0; v < in.drawn.count(); ++v) {
        if (!is_converted(in.drawn, v)) continue;
        const LightTimer time(out.cpu_us, in.drawn.view(v).light);
        record_view(in, v, offset, out.list);
        offset += stride;
    }
}

}  // namespace gnomon::shadow
