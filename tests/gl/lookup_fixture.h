#pragma once
#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"
#include "systems/lookup/lookup_glsl.h"
#include "systems/lookup/lookup_table.h"
#include "systems/shadow/frame/shader_key.h"
#include "tests/gl/held_frame_fixture.h"

namespace gnomon {

/// World with lights that one program looks up in one draw, beside the lighting's own passes.
class LookupTest : public HeldFrameTest {
protected:
    /// Units and bindings that the surfaces leave free.
    static constexpr lookup::LookupBindings kBindings{.first_texture_unit = 7,
                                                      .texture_unit_count = 15,
                                                      .storage_binding = 3};
    static constexpr std::uint32_t kResultBinding = 6, kPlaceBinding = 5;

    void TearDown() override {
        table.reset();
        for (const gl::BufferHandle buffer : {results_, copied_}) device().destroy(buffer);
        HeldFrameTest::TearDown();
    }

    /// Makes the parts of a frame, with maps in shared arrays, and the text, in its way for this device.
    void start(lookup::LookupRows rows = {}) {
        rows.for_hardware = rows.for_hardware || !device().info().is_software;
        auto made = GpuScene::create(device(), library);
        ASSERT_TRUE(made);
        scene = std::make_unique<GpuScene>(std::move(made).value());
        shadows = std::make_unique<shadow::ShadowSystem>(device());
        shadows->share_layers();
        lighting = std::make_unique<lighting::LightingSystem>(device());
        auto written = lookup::lookup_glsl(kBindings, rows);
        ASSERT_TRUE(written) << to_line(written.error());
        text = std::move(written).value();
        table = std::make_unique<lookup::LookupTable>(device(), kBindings, rows);
    }

    /// Returns a program that looks all lights up at every surface. `call`: the lookup of `light` at `surface`.
    gl::ProgramHandle surface_program(const std::string& call =
                                          "gnomon_uniform_visibility(light, surface.position_ca, surface.geometric_normal, "
                                          "surface.error_m)") {
        const std::string main =
            "#include \"lighting/gbuffer/gbuffer_read.glsl\"\n" + text +
            "layout(std430, binding = 6) buffer Results { float results[]; };\n"
            "void main() {\n"
            "    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(surface_depth, 0);\n"
            "    gnomon_pixel = gl_FragCoord.xy;\n"
            "    Surface surface = read_surface(pixel);\n"
            "    for (int light = 0; light < gnomon_light_count(); ++light) {\n"
            "        float seen = -1.0;\n"
            "        if (surface.exists) seen = " + call + ";\n"
            "        results[(light * size.y + pixel.y) * size.x + pixel.x] = seen;\n"
            "    }\n"
            "}\n";
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        files.push_back({"mine/main.frag", main});
        const auto defines = shadow::program_defines({"LIGHT_SPOT", {}, {}});
        const auto vertex = gl::expand_shader(files, "common/fullscreen.vert", defines);
        const auto fragment = gl::expand_shader(files, "mine/main.frag", defines);
        EXPECT_TRUE(vertex && fragment);
        return keep(device().create_program({"all lights", vertex.value(), fragment.value()}));
    }

    /// Returns what the program sees of each light, pixel by pixel, in the frame of the last run().
    std::vector<std::vector<float>> looked_up(gl::ProgramHandle program) {
        gl::CommandList list;
        EXPECT_TRUE(table->update(inputs(), *scene, list));
        const std::size_t pixels = std::size_t{settings.viewport_px.x} * settings.viewport_px.y;
        const std::size_t values = pixels * inputs().lights.size();
        provide_results(values);
        list.add(gl::BeginPass{.target = lighting->picture_target(), .viewport = whole()});
        list.add(gl::SetPipeline{{.program = program}});
        lighting->bind_surface_textures(list);
        table->bind(list);
        list.add(gl::BindStorage{kResultBinding, results_});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{true});
        list.add(gl::CopyBuffer{results_, copied_});
        GlTest::run(list);
        device().finish();
        std::vector<float> read(values);
        EXPECT_EQ(device().read_buffer(copied_, std::as_writable_bytes(std::span(read))), gl::Readback::done);
        std::vector<std::vector<float>> of_lights;
        for (std::size_t i = 0; i < inputs().lights.size(); ++i)
            of_lights.emplace_back(read.begin() + static_cast<std::ptrdiff_t>(i * pixels),
                                   read.begin() + static_cast<std::ptrdiff_t>((i + 1) * pixels));
        return of_lights;
    }

    /// Returns the same by the lighting's own pass.
    std::vector<float> recorded(std::uint32_t light) {
        gl::CommandList list;
        EXPECT_TRUE(lighting->record_visibility(inputs(), light, *scene, list));
        GlTest::run(list);
        return read<float>(lighting->visibility_texture(), std::size_t{settings.viewport_px.x} * settings.viewport_px.y);
    }

    struct Difference {
        double largest = 0.0;
        std::size_t pixels = 0, dark = 0, lit = 0;  // pixels: that differ by more than rounding
    };
    static constexpr double kRounding = 1e-5;
    static Difference difference(const std::vector<float>& a, const std::vector<float>& b) {
        Difference d;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double apart = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
            d.largest = std::max(d.largest, apart);
            d.pixels += apart > kRounding ? 1 : 0;
            d.dark += a[i] >= 0.0f && a[i] < 0.5f ? 1 : 0;
            d.lit += a[i] > 0.9f ? 1 : 0;
        }
        return d;
    }

    gl::Rect whole() const {
        return {0, 0, static_cast<std::int32_t>(settings.viewport_px.x), static_cast<std::int32_t>(settings.viewport_px.y)};
    }

    void provide_results(std::size_t values) {
        if (values == values_) return;
        for (const gl::BufferHandle buffer : {results_, copied_}) device().destroy(buffer);
        results_ = device().create_buffer({"results", values * 4, gl::BufferUse::updated}, {}).handle;
        copied_ = device().create_buffer({"copied", values * 4, gl::BufferUse::read_back}, {}).handle;
        values_ = values;
    }

    std::string text;
    std::unique_ptr<lookup::LookupTable> table;
    gl::BufferHandle results_{}, copied_{};

private:
    std::size_t values_ = 0;
};

}  // namespace gnomon
