#include "tests/system/fault_play.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "systems/shadow/request/filter_table.h"
#include "systems/shadow/request/light_kinds.h"
#include "tests/system/passes.h"

namespace gnomon {
namespace {

using Kind = gl::ResourceCall::Kind;

bool is_call(Kind kind) {
    return kind == Kind::create_texture || kind == Kind::create_sampler || kind == Kind::create_buffer ||
           kind == Kind::create_program || kind == Kind::create_target || kind == Kind::submit ||
           kind == Kind::read_buffer;
}

bool starts_with(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

/// Reasons that a device can give.
bool is_loss(Reason reason) {
    switch (reason) {
        case Reason::map_shrunk:
        case Reason::map_allocation_failed:
        case Reason::target_incomplete:
        case Reason::depth_program_failed:
        case Reason::lighting_program_failed:
        case Reason::filter_program_failed:
        case Reason::buffer_failed:
        case Reason::sampler_failed:
        case Reason::depths_unread:
            return true;
        default:
            return false;
    }
}

/// Returns the filter by which the light's own passes of the picture look its shadow up. Automatic: they do not. If
/// they use two filters, it is the last.
ShadowFilter drawn_filter(const std::vector<Pass>& passes, const std::string& light,
                          const gl::RecordingDevice& device) {
    ShadowFilter drawn = ShadowFilter::automatic;
    for (const Pass& pass : passes) {
        if (pass.group != light || pass.is_depth) continue;
        for (const gl::PipelineState& state : pass.pipelines) {
            const gl::ProgramDesc* program = device.program(state.program);
            for (const shadow::FilterRow& row : shadow::filter_table())
                if (program && program->label.find(row.file) != std::string::npos) drawn = row.id;
        }
    }
    return drawn;
}

}  // namespace

FaultPlay::FaultPlay(FaultScene scene) : scene_(std::move(scene)) {
    Host host;
    const auto note_calls = [&](int frame) {
        for (const gl::ResourceCall& call : host.device->resource_calls())
            if (is_call(call.kind))
                calls_.push_back({frame, call.kind == Kind::submit, call.kind == Kind::read_buffer, call.label});
        host.device->forget();
    };
    auto made = FrameSystem::create(*host.device, *scene_.library);
    EXPECT_TRUE(made);
    host.frame = std::move(made).value();
    note_calls(-1);
    for (int i = 0; i < kFaultyFrames + kMostFramesToRecover; ++i) {
        sound_.push_back(run_frame(host, i));
        if (i < kFaultyFrames) note_calls(i);
    }
}

/// Sets the frame up under the fault. False: refused. Then nothing may be left behind, and the host tries again without
/// the fault.
bool FaultPlay::set_up(Host& host, const Fault& fault) {
    auto made = FrameSystem::create(*host.device, *scene_.library);
    if (!made) {
        EXPECT_EQ(made.error().rule, "gpu.scene");
        EXPECT_EQ(host.device->live_count(), 0u);
        if (fault.failure == gl::Failure::context_lost) host.device = std::make_unique<gl::RecordingDevice>();
        host.device->stop_failing();
        made = FrameSystem::create(*host.device, *scene_.library);
        if (!made) ADD_FAILURE() << "set-up fails without a fault: " << to_line(made.error());
        if (made) host.frame = std::move(made).value();
        return false;
    }
    host.frame = std::move(made).value();
    return true;
}

std::vector<FaultPlay::LightOutcome> FaultPlay::run_frame(Host& host, int index) {
    scene_.play(index);
    host.frame->run(*scene_.registry,
                    {.viewport_px = {320, 180}, .exposure_ev = {}, .present = true, .repeatable = true});
    const std::vector<Pass> passes = passes_of(host.frame->commands(), *host.device);
    std::vector<LightOutcome> lights;
    const std::vector<LightReport>& reports = host.frame->report().lights;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const LightReport& light = reports[i];
        const ShadowFilter filter = host.frame->snapshot().lights[i].shadow.filter;
        const ShadowFilter drawn = drawn_filter(passes, light.name, *host.device);
        lights.push_back({light.name, light.kind, light.state, light.reason, light.counts.bytes,
                          drawn != ShadowFilter::automatic, shadow::filter_row(filter).file, drawn, light.filter.filter,
                          light.predicted_error_px, light.keeps_max_error});
    }
    return lights;
}

/// Expects that the report states what was drawn: no light loses anything in silence.
void FaultPlay::expect_consistent(const std::vector<LightOutcome>& lights, int index, bool picture) const {
    const auto& sound = sound_[static_cast<std::size_t>(index)];
    ASSERT_EQ(lights.size(), sound.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const LightOutcome& light = lights[i];
        if (picture) {
            EXPECT_EQ(light.samples_map, light.state != LightState::skipped) << light.name;
            EXPECT_EQ(light.drawn, light.said) << light.name << " is looked up in another way than it says";
            const bool exact = shadow::filter_row(light.drawn).rays;
            // Blended surfaces may have fallen back where all others did not.
            if (!exact || !is_loss(light.reason)) {
                EXPECT_EQ(light.predicted_error_px > 0.0, light.samples_map && !exact) << light.name;
            }
            EXPECT_TRUE(light.samples_map || !light.keeps_max_error) << light.name;
        }
        const bool less = light.bytes < sound[i].bytes || (picture && sound[i].samples_map && !light.samples_map);
        if (less) {
            EXPECT_TRUE(is_loss(light.reason))
                << light.name << " lost something but says " << reason_code(light.reason);
        }
    }
}

/// Expects that the lights that report a loss are exactly the lights that the call was made for.
void FaultPlay::expect_named(const std::vector<LightOutcome>& lights, const Call& call) const {
    std::vector<std::string> lost, expected;
    for (const LightOutcome& light : lights)
        if (is_loss(light.reason)) lost.push_back(light.name);
    const bool is_sampler =
        starts_with(call.label, "shadow compare") || call.label == "shadow depths" || call.label == "shadow moments";
    const bool of_all = is_sampler || call.label == "caster triangles" || call.label == "caster masks" ||
                        starts_with(call.label, "catcher ") || call.label == "caught light" ||
                        call.label == "caught light, depth" || (call.frame == 0 && call.label == "instances");
    // All lights with rays share these.
    bool of_rays = call.label.find("as found") != std::string::npos;
    for (const char* shared : {"ray ", "sheet ", "shadow sheet ", "surface places", "surface with places",
                               "verdicts of maps", "answers of rays", "pixels for rays"})
        of_rays = of_rays || starts_with(call.label, shared);
    const bool of_some = of_rays || starts_with(call.label, "depth ") || starts_with(call.label, "shadow draw items") ||
                         starts_with(call.label, "shadow views") || starts_with(call.label, "moments ") ||
                         call.label == "shadow moment records" || (call.frame > 0 && call.label == "instances");
    // Without the first of a light's two draws the second is its only one: that costs time and nothing else.
    const bool of_speed = starts_with(call.label, "decided light ");
    const bool of_kind = call.label.find("filters") != std::string::npos && !of_some && !of_speed;
    for (const LightOutcome& light : lights) {
        const std::string map = "shadow map " + light.name;
        const bool own = call.label == map || starts_with(call.label, map + ", ");  // triangles, moments, scratch
        const std::string define = " " + std::string(shadow::light_kind_row(light.kind).define) + " ";
        const bool sun_unread = call.is_reading && light.kind == LightKind::directional;
        if (own || of_all || sun_unread ||
            (of_kind && call.label.find(define + std::string(light.filter_file)) != std::string::npos))
            expected.push_back(light.name);
    }
    if (of_some) {
        EXPECT_FALSE(lost.empty());
    } else {
        EXPECT_EQ(lost, expected);
    }
}

void FaultPlay::expect_delivered(const Host& host, int index, const Fault& fault,
                                 const std::vector<LightOutcome>& lights) {
    const Call& call = calls_[fault.call];
    const gl::Failure said = host.frame->report().failure;
    const bool picture = static_cast<bool>(host.frame->picture_target());
    expect_consistent(lights, index, picture);
    if (!picture) {
        EXPECT_NE(said, gl::Failure::none) << "no picture, and no word";
    }
    if (fault.failure == gl::Failure::context_lost) {
        EXPECT_EQ(said == gl::Failure::context_lost, index >= call.frame) << gl::to_text(said);
    } else if (fault.span == FaultSpan::once) {
        EXPECT_TRUE(picture);
        EXPECT_EQ(said, call.is_submission && call.frame == index ? fault.failure : gl::Failure::none);
        if (call.frame == index) expect_named(lights, call);
    }
}

void FaultPlay::expect_recovery(Host& host) {
    for (int i = kFaultyFrames; i < kFaultyFrames + kMostFramesToRecover; ++i) {
        const std::vector<LightOutcome> lights = run_frame(host, i);
        const auto& sound = sound_[static_cast<std::size_t>(i)];
        const bool back = std::equal(
            lights.begin(), lights.end(), sound.begin(), sound.end(), [](const LightOutcome& a, const LightOutcome& b) {
                return !is_loss(a.reason) && a.bytes == b.bytes && a.samples_map == b.samples_map;
            });
        if (back && host.frame->report().failure == gl::Failure::none && host.frame->picture_target()) return;
    }
    ADD_FAILURE() << "shadows are not back " << kMostFramesToRecover << " frames after the fault";
}

void FaultPlay::expect_nothing_left(Host& host) {
    host.frame.reset();
    host.device->check_leaks();
    for (const gl::Finding& f : host.device->findings()) ADD_FAILURE() << gl::to_text(f.misuse) << ": " << f.detail;
}

void FaultPlay::check(const Fault& fault) {
    const Call& call = calls_.at(fault.call);
    SCOPED_TRACE("call " + std::to_string(fault.call) + " (" + (call.is_submission ? "submission" : call.label) +
                 ", frame " + std::to_string(call.frame) + ")");
    Host host;
    if (fault.span == FaultSpan::once)
        host.device->fail_call(fault.call, fault.failure);
    else
        host.device->fail_from(fault.call, fault.failure, fault.span == FaultSpan::all_calls);
    const bool faulty = set_up(host, fault);
    EXPECT_EQ(faulty, call.frame >= 0);
    if (!host.frame) return;
    for (int i = 0; faulty && i < kFaultyFrames; ++i) expect_delivered(host, i, fault, run_frame(host, i));
    host.device->stop_failing();
    if (faulty && fault.failure == gl::Failure::context_lost) {
        // All that lived on the lost context goes, whatever state it is in; the world does not.
        expect_nothing_left(host);
        host = Host{};
        set_up(host, fault);
    }
    expect_recovery(host);
    expect_nothing_left(host);
}

}  // namespace gnomon
