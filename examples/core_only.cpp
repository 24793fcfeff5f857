// Shadow maps for another API. Gnomon::core fits them, and this program prints what an engine would upload and draw: on
// Vulkan, Direct3D, Metal, WebGPU or OpenGL. It links GLM and nothing else.
#include <gnomon/core.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <vector>

namespace {

namespace core = gnomon::core;

constexpr const char* kHelp =
    "usage: core_only [--api opengl|vulkan|direct3d|metal|webgpu] [--depth reversed|standard] [--frames N]\n"
    "                 [--max-error PIXELS] [--help]\n"
    "Prints, for a sun, a spot and a point light over a yard, each map's matrix, size, depth range, casters and "
    "error.\n"
    "--api        convention of the matrices; default vulkan\n"
    "--depth      near is 1 (reversed, default) or 0 (standard)\n"
    "--frames     frames in which the camera walks before the last one is printed; default 1, at most 100000\n"
    "--max-error  allowed error of a shadow's edge on screen, pixels; default 0: what usual sizes give\n";

struct Api {
    const char* name;
    core::Convention convention;
};
constexpr Api kApis[] = {{"opengl", core::kOpenGl},
                         {"vulkan", core::kVulkan},
                         {"direct3d", core::kDirect3D},
                         {"metal", core::kMetal},
                         {"webgpu", core::kWebGpu}};

struct Options {
    Api api = kApis[1];
    int frames = 1;
    float max_error_px = 0.0f;
    bool help = false;
};

/// Reads the command line. Returns false for one without meaning.
bool read(int count, char** words, Options& options) {
    bool reversed = true;
    for (int i = 1; i < count; ++i) {
        const char* flag = words[i];
        if (std::strcmp(flag, "--help") == 0) {
            options.help = true;
            continue;
        }
        if (++i == count) return false;
        const char* value = words[i];
        char* end = nullptr;
        if (std::strcmp(flag, "--api") == 0) {
            const Api* found = nullptr;
            for (const Api& api : kApis)
                if (std::strcmp(api.name, value) == 0) found = &api;
            if (!found) return false;
            options.api = *found;
        } else if (std::strcmp(flag, "--depth") == 0) {
            reversed = std::strcmp(value, "reversed") == 0;
            if (!reversed && std::strcmp(value, "standard") != 0) return false;
        } else if (std::strcmp(flag, "--frames") == 0) {
            const long frames = std::strtol(value, &end, 10);
            if (*end != '\0' || frames < 1 || frames > 100000) return false;
            options.frames = static_cast<int>(frames);
        } else if (std::strcmp(flag, "--max-error") == 0) {
            options.max_error_px = std::strtof(value, &end);
            if (*end != '\0' || !(options.max_error_px >= 0.0f)) return false;
        } else {
            return false;
        }
    }
    options.api.convention.reversed_depth = reversed;
    return true;
}

/// Columns right, up, back of what looks along `ahead`.
glm::dmat3 looking(const glm::dvec3& ahead) {
    const glm::dvec3 back = -glm::normalize(ahead);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
    return {right, glm::cross(back, right), back};
}

// [scene]
/// The engine's own scene: boxes around what it draws, lights, a camera.
struct Yard {
    std::vector<core::Box> boxes;
    std::vector<core::Light> lights;
    core::Camera camera;
};

Yard make_yard() {
    Yard yard;
    const auto add_box = [&](const glm::dvec3& low, const glm::dvec3& size) {
        core::Box box;
        box.min_ws_m = low;
        box.max_ws_m = low + size;
        yard.boxes.push_back(box);
    };
    for (int x = -3; x < 3; ++x)  // the ground, in tiles
        for (int z = -3; z < 3; ++z) add_box({4.0 * x, -0.1, 4.0 * z}, {4.0, 0.1, 4.0});
    for (int i = 0; i < 5; ++i) add_box({-6.0 + 3.0 * i, 0.0, -1.0 - i}, {0.5, 1.5 + 0.5 * i, 0.5});

    core::Light sun, spot, bulb;
    sun.id = 1;  // any number that stays the light's own
    sun.kind = core::LightKind::directional;
    sun.rotation_ws = looking({-3.0, -5.0, -2.0});
    spot.id = 2;
    spot.kind = core::LightKind::spot;
    spot.position_ws_m = {5.0, 6.0, 5.0};
    spot.rotation_ws = looking(-spot.position_ws_m);
    spot.range_m = 20.0f;
    bulb.id = 3;
    bulb.kind = core::LightKind::point;
    bulb.position_ws_m = {-1.0, 2.5, 1.5};
    bulb.range_m = 12.0f;
    yard.lights = {sun, spot, bulb};
    return yard;
}
// [scene]

// [maps]
/// Prints what an engine takes of one light's fit.
void print_light(const char* name, const core::Fits& fits, std::size_t light) {
    const core::LightFit& fit = fits.lights()[light];
    std::printf("%s: %s: %s\n", name, core::to_text(fit.status), core::sentence(fit.status));
    if (!core::has_maps(fit.status)) return;
    std::printf("  %s of %u layers, %u px, error %.2f px\n", fit.cube ? "cube" : "array", fit.layers, fit.map_px,
                fit.edge_error_px);
    for (const core::View& view : fits.views_of(light)) {
        std::printf("  layer %u: %.3f to %.3f m, error %.2f px, casters", view.layer, view.near_m, view.far_m,
                    view.edge_error_px);
        for (const std::uint32_t box : fits.casters_of(view)) std::printf(" %u", box);
        std::printf("\n    anchor %.6f %.6f %.6f\n", view.anchor_ws_m.x, view.anchor_ws_m.y, view.anchor_ws_m.z);
        for (int r = 0; r < 4; ++r) {
            const glm::vec4 row = glm::row(view.map_from_anchor, r);
            std::printf("    map_from_anchor[%d] % .8e % .8e % .8e % .8e\n", r, static_cast<double>(row.x),
                        static_cast<double>(row.y), static_cast<double>(row.z), static_cast<double>(row.w));
        }
        std::printf("    bias: texel %.6g %.6g, reach %.4f texels, depth %.3g\n", view.bias.texel.x, view.bias.texel.y,
                    view.bias.reach_texel, view.bias.depth);
    }
}
// [maps]

}  // namespace

int main(int count, char** words) {
    Options options;
    if (!read(count, words, options)) {
        std::fprintf(stderr, "core_only: unknown or incomplete flag\n%s", kHelp);
        return 2;
    }
    if (options.help) {
        std::printf("%s", kHelp);
        return 0;
    }
    Yard yard = make_yard();
    for (core::Light& light : yard.lights) light.shadow.max_error_px = options.max_error_px;

    // [frame]
    core::History history;  // one per world, kept
    core::Fits fits;        // storage that every frame reuses
    core::Settings settings;
    settings.convention = options.api.convention;
    for (int frame = 0; frame < options.frames; ++frame) {
        yard.camera.position_ws_m = {0.01 * frame, 3.0, 10.0};
        yard.camera.rotation_ws = looking({0.0, -0.2, -1.0});
        const core::Scene scene{{&yard.camera, 1}, yard.lights, yard.boxes};
        core::fit_shadows(scene, settings, history, fits);
    }
    // [frame]

    std::printf("api %s, depth %s\n", options.api.name, settings.convention.reversed_depth ? "reversed" : "standard");
    const char* const names[] = {"sun", "spot", "bulb"};
    for (std::size_t i = 0; i < yard.lights.size(); ++i) print_light(names[i], fits, i);
    // [place]
    // A caster's corner in the sun's map: texture coordinates and depth, as a shader computes them.
    const glm::dvec3 corner = yard.boxes.back().max_ws_m;
    const core::View& view = fits.views_of(0).front();
    const glm::dvec3 place = core::map_place(view, corner);
    const core::Offset offset = core::offset_at(view, corner, {0.0, 1.0, 0.0});
    // [place]
    std::printf("corner of box %zu under the sun: %.5f %.5f %.5f, offset %.5f m along the normal and %.3g of depth\n",
                yard.boxes.size() - 1, place.x, place.y, place.z, offset.along_normal_m, offset.depth);
    return 0;
}
