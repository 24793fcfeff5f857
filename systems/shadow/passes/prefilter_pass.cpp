#include "systems/shadow/passes/prefilter_pass.h"

#include <algorithm>
#include <cstring>
#include <string>

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

/// Of a cube's far plane the corner is this much farther than the middle
/// (shaders/shadow/passes/prefilter/linear_distance.glsl).
constexpr double kCubeCorner = 1.7320508075688772;

bool is_cube(const ShadowView& view) { return view.projection == ViewProjection::cube_face; }

bool is_converted(const ShadowFrame& frame, std::size_t view) {
    return frame.slots[view].moment_target && frame.slots[view].convert;
}

/// A bit per face that has a view of this demand.
std::int32_t faces_of(const ShadowFrame& frame, std::uint32_t demand) {
    std::int32_t faces = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (frame.views[v].demand == demand && frame.slots[v].texture) faces |= 1 << frame.views[v].layer;
    return faces;
}

void draw_whole(gl::TargetHandle target, std::uint32_t width, std::uint32_t height, gl::ProgramHandle program,
                gl::TextureHandle source, gl::CommandList& list) {
    const gl::Rect whole{0, 0, static_cast<std::int32_t>(width), static_cast<std::int32_t>(height)};
    list.add(gl::BeginPass{target, whole, false, 0.0f, false, {}});
    list.add(gl::SetPipeline{{program, gl::CullMode::none, false, gl::DepthTest::off, false, false, gl::Blend::off}});
    list.add(gl::BindTexture{0, source, {}});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
}

}  // namespace

MomentRecord moment_record(const ShadowDemand& demand, const ShadowView& view, std::int32_t faces) {
    MomentRecord record;
    record.settings = demand.moments.settings;
    const double farthest_m = view.far_m * (is_cube(view) ? kCubeCorner : 1.0);
    record.range = {static_cast<float>(view.depth_alpha), static_cast<float>(view.depth_beta),
                    static_cast<float>(view.near_m), static_cast<float>(1.0 / (farthest_m - view.near_m))};
    record.place = {static_cast<std::int32_t>(view.layer), static_cast<std::int32_t>(demand.filtering.size / 2),
                    static_cast<std::int32_t>(scratch_rows(demand, is_cube(view))), faces};
    if (is_cube(view)) {
        const CubeFace& face = cube_face(view.layer);
        record.axis_u = glm::vec4(glm::vec3(face.axis_u), 0.0f);
        record.axis_v = glm::vec4(glm::vec3(face.axis_v), 0.0f);
        record.axis_back = glm::vec4(glm::vec3(face.axis_back), 0.0f);
    }
    const auto weights = blur_weights(demand.filtering.size);
    static_assert(sizeof record.weights == sizeof weights);
    std::memcpy(record.weights, weights.data(), sizeof weights);
    return record;
}

MomentRecorder::~MomentRecorder() {
    for (const Program& p : programs_) device_.destroy(p.program);
}

MomentRecorder::Source MomentRecorder::source_of(const ShadowView& view) {
    if (is_cube(view)) return Source::cube;
    return view.projection == ViewProjection::perspective ? Source::perspective : Source::orthographic;
}

gl::ProgramHandle MomentRecorder::program(std::string_view filter_file, Source source) {
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

bool MomentRecorder::ready(const ShadowFrame& frame, std::size_t v) {
    const ShadowDemand& demand = frame.demands[frame.views[v].demand];
    return program(filter_row(demand.filter).file, source_of(frame.views[v])) &&
           (!frame.slots[v].scratch || program({}, Source::scratch));
}

void MomentRecorder::prepare(ShadowFrame& frame) {
    ++frame_;
    std::size_t count = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_converted(frame, v)) continue;
        const LightTime time(frame, frame.demands[frame.views[v].demand].light);
        if (ready(frame, v))
            ++count;
        else
            drop_moments(frame, frame.views[v].demand);
    }
    if (count == 0 || records_.reserve(count * aligned(sizeof(MomentRecord), device_.info().uniform_alignment))) return;
    for (std::size_t v = 0; v < frame.views.size(); ++v)
        if (is_converted(frame, v)) drop_light(frame, frame.views[v].demand, Reason::buffer_failed);
}

void MomentRecorder::record_view(const SceneSnapshot& scene, const ShadowFrame& frame, std::size_t v,
                                 std::uint32_t offset, gl::CommandList& list) {
    const ShadowView& view = frame.views[v];
    const ShadowDemand& demand = frame.demands[view.demand];
    const ShadowSlot& slot = frame.slots[v];
    list.add(gl::BeginGroup{{"moments", scene.lights[demand.light].name, std::to_string(view.layer)}});
    list.add(gl::BeginTimer{shadow_timer(demand.light)});
    list.add(gl::BindUniforms{0, records_.handle(), offset, sizeof(MomentRecord)});
    const gl::ProgramHandle first = program(filter_row(demand.filter).file, source_of(view));
    if (slot.scratch) {
        const std::uint32_t rows = slot.size_px + 2 * scratch_rows(demand, is_cube(view));
        draw_whole(slot.scratch_target, slot.size_px, rows, first, slot.texture, list);
        draw_whole(slot.moment_target, slot.size_px, slot.size_px, program({}, Source::scratch), slot.scratch, list);
    } else {
        draw_whole(slot.moment_target, slot.size_px, slot.size_px, first, slot.texture, list);
    }
    bool last = true;
    for (std::size_t next = v + 1; next < frame.views.size(); ++next)
        last = last && !(frame.views[next].demand == view.demand && is_converted(frame, next));
    if (last && demand.moments.levels > 1) list.add(gl::GenerateMips{slot.moments});
    list.add(gl::EndTimer{shadow_timer(demand.light)});
    list.add(gl::EndGroup{});
}

void MomentRecorder::record(const SceneSnapshot& scene, ShadowFrame& frame, gl::CommandList& list) {
    const std::uint32_t stride = aligned(sizeof(MomentRecord), device_.info().uniform_alignment);
    record_scratch_.clear();
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_converted(frame, v)) continue;
        const ShadowView& view = frame.views[v];
        const MomentRecord record =
            moment_record(frame.demands[view.demand], view, is_cube(view) ? faces_of(frame, view.demand) : 0);
        const std::size_t at = record_scratch_.size();
        record_scratch_.resize(at + stride);
        std::memcpy(record_scratch_.data() + at, &record, sizeof record);
    }
    if (record_scratch_.empty()) return;
    list.update(records_.handle(), 0, std::span<const std::byte>(record_scratch_));
    std::uint32_t offset = 0;
    for (std::size_t v = 0; v < frame.views.size(); ++v) {
        if (!is_converted(frame, v)) continue;
        const LightTime time(frame, frame.demands[frame.views[v].demand].light);
        record_view(scene, frame, v, offset, list);
        offset += stride;
    }
}

}  // namespace gnomon::shadow
