#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iostream>

#include "engine/gl/shader_source.h"
#include "shaders/bindings.h"
#include "shaders/embedded.h"
#include "systems/extract/gpu_scene.h"
#include "systems/shadow/publish/publish_lights.h"
#include "systems/truth/picture_ray.h"
#include "tests/gl/gl_test_context.h"
#include "tests/gl/sheet_worlds.h"
#include "tests/unit/math/random_seed.h"

/// Where a pixel looks at a triangle's plane, as maps of sheets are queried. The place in float is off from the one in
/// double by no more than its own bound. Random worlds, cameras, triangles and pixels, the triangles' own and others.
namespace gnomon {
namespace {

using test::between;
using test::chance;
using test::QueryScene;
using test::Random;

/// Texels of shaders/lighting/gbuffer/visible_triangle.glsl, each with its pixel.
struct Asked {
    glm::uvec4 place{0u};
    glm::uvec4 pixel{0u};
};
struct Answer {
    float apart_m = 0.0f;  // distance of float's place from double's
    float error_m = 0.0f;  // bound on that distance
    float distance_m = 0.0f;
    float looked = 0.0f;  // 1 in what was drawn
};

ConsumerItem random_camera(Random& random, const glm::dvec3& offset_m) {
    ConsumerItem camera;
    camera.position_ws_m = offset_m + test::point_in(random, 8.0) + glm::dvec3(0.0, 2.0, 0.0);
    camera.rotation_ws = glm::mat3_cast(glm::angleAxis(between(random, 0.0, 6.3), test::direction(random)));
    if (chance(random, 0.4))  // upright
        camera.rotation_ws = glm::mat3_cast(glm::angleAxis(between(random, 0.0, 6.3), glm::dvec3(0.0, 1.0, 0.0)));
    if (chance(random, 0.2))  // along the world's axes, as walls are: near its middle a ray's numbers cancel
        camera.rotation_ws = glm::mat3_cast(
            glm::angleAxis(0.5 * glm::pi<double>() * static_cast<double>(random() % 4), glm::dvec3(0.0, 1.0, 0.0)));
    if (chance(random, 0.3)) camera.projection = CameraProjection::orthographic;
    camera.fov_y_rad = between(random, 0.1, 2.0);
    camera.far_m = 100.0;
    return camera;
}

/// Distance that stands for the rasteriser's. hardly: so far from the plane's that rounding decides whether
/// that one is believed (lighting/gbuffer/visible_triangle.glsl).
enum class Interpolated : std::uint8_t { there, hardly };

/// Returns the distance along the view at which a pixel's centre sees the plane of three corners, in double.
double plane_distance_m(const ConsumerItem& camera, const glm::uvec2& pixel, const glm::dvec3 (&corners_ws_m)[3]) {
    const truth::PictureRay ray = truth::picture_ray(camera, glm::dvec2(pixel));
    const glm::dvec3 normal = glm::cross(corners_ws_m[1] - corners_ws_m[0], corners_ws_m[2] - corners_ws_m[0]);
    // An orthographic ray starts at the near plane.
    const double start_m = camera.projection == CameraProjection::orthographic ? camera.near_m : 0.0;
    return start_m + glm::dot(normal, corners_ws_m[0] - ray.from_ws_m) / glm::dot(normal, ray.along);
}

class SeenPlaces : public GlTest {
protected:
    /// Returns pixels, each with a triangle that it may show.
    std::vector<Asked> ask_about(const QueryScene& scene, const GpuScene& gpu, const ConsumerItem& camera,
                                 Random& random, std::size_t count, Interpolated interpolated) const {
        const double half_height = camera.projection == CameraProjection::orthographic
                                       ? camera.half_height_m
                                       : std::tan(0.5 * camera.fov_y_rad);
        const glm::dvec2 size(camera.viewport_px);
        std::vector<Asked> asked;
        for (std::size_t tries = 0; tries < 200 * count && asked.size() < count; ++tries) {
            const auto i = static_cast<std::uint32_t>(random() % scene.snapshot.instances.size());
            const InstanceItem& item = scene.snapshot.instances[i];
            const GpuScene::MeshShape shape = gpu.shape(item.mesh);
            const auto triangle = static_cast<std::uint32_t>(random() % (shape.indices->size() / 3));
            glm::dvec3 corners_ws_m[3];
            for (std::uint32_t c = 0; c < 3; ++c) {
                const assets::Vertex& vertex = (*shape.vertices)[(*shape.indices)[3 * triangle + c]];
                corners_ws_m[c] = item.basis * glm::dvec3(vertex.position_ms) + item.translation_ws_m;
            }
            const double u = between(random, 0.0, 1.0), v = between(random, 0.0, 1.0 - u);
            const glm::dvec3 at_ws_m =
                corners_ws_m[0] + u * (corners_ws_m[1] - corners_ws_m[0]) + v * (corners_ws_m[2] - corners_ws_m[0]);
            const glm::dvec3 at = glm::transpose(camera.rotation_ws) * (at_ws_m - camera.position_ws_m);
            const double away_m = -at.z;
            if (away_m < camera.near_m || away_m > camera.far_m) continue;
            glm::dvec2 ndc = glm::dvec2(at) / (half_height * glm::dvec2(size.x / size.y, 1.0));
            if (camera.projection == CameraProjection::perspective) ndc /= away_m;
            if (std::abs(ndc.x) >= 1.0 || std::abs(ndc.y) >= 1.0) continue;
            const glm::uvec2 pixel((ndc * 0.5 + 0.5) * size);
            const GpuScene::MeshRange& mesh = gpu.mesh(item.mesh);
            double interpolated_m = away_m;
            if (interpolated == Interpolated::hardly) {
                // Half of it away, or as much as it again, to a few units of a float's rounding.
                const double share = chance(random, 0.5) ? 1.5 : 0.5;
                interpolated_m = plane_distance_m(camera, pixel, corners_ws_m) / share *
                                 (1.0 + between(random, -8.0, 8.0) * 0x1p-24);
                // A plane that is seen edge-on is nowhere, or anywhere.
                if (!(interpolated_m > 0.0 && interpolated_m < camera.far_m)) continue;
            }
            const std::uint32_t corner = (*shape.indices)[3 * triangle + static_cast<std::uint32_t>(random() % 3)];
            asked.push_back({{std::bit_cast<std::uint32_t>(static_cast<float>(interpolated_m)),
                              static_cast<std::uint32_t>(mesh.base_vertex) + corner, item.gpu_slot,
                              mesh.first_index / 3 + triangle},
                             {pixel, 0u, 0u}});
        }
        return asked;
    }

    std::vector<Answer> answers(QueryScene& scene, const ConsumerItem& camera, Random& random, std::size_t count,
                                bool rounds, Interpolated interpolated = Interpolated::there) {
        auto made = GpuScene::create(device(), scene.library);
        EXPECT_TRUE(made);
        GpuScene gpu = std::move(made).value();
        gl::CommandList list;
        for (std::uint32_t i = 0; i < scene.snapshot.instances.size(); ++i)
            scene.snapshot.changed_instances.push_back(i);
        EXPECT_TRUE(gpu.update(scene.snapshot, list));
        const std::vector<Asked> asked = ask_about(scene, gpu, camera, random, count, interpolated);
        if (asked.empty()) return {};
        const auto buffer = [&](const char* label, auto bytes) {
            return device()
                .create_buffer({.label = label, .size = bytes.size(), .use = gl::BufferUse::fixed}, bytes)
                .handle;
        };
        const shadow::CameraRecord record = shadow::camera_record(camera);
        const auto block = buffer("camera", std::as_bytes(std::span(&record, 1)));
        const auto places = buffer("asked", std::as_bytes(std::span(asked)));
        const auto width = static_cast<std::uint32_t>(asked.size());
        const auto out =
            device()
                .create_texture({.label = "answers", .format = gl::Format::rgba32f, .width = width, .height = 1}, {})
                .handle;
        const auto target = device().create_target({"answers", {{out}}, {}}).handle;
        list.add(gl::BeginPass{.target = target, .viewport = {0, 0, static_cast<std::int32_t>(width), 1}});
        list.add(gl::SetPipeline{{.program = program(rounds)}});
        list.add(gl::BindUniforms{0, block, 0, sizeof record});
        list.add(gl::BindStorage{1, places});
        list.add(gl::BindTexels{9, gpu.vertices()});
        list.add(gl::BindTexels{bindings::kInstanceUnit, gpu.instances()});
        list.add(gl::BindTexels{bindings::kTriangleNormalUnit, gpu.triangle_normals()});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
        std::vector<Answer> found = read<Answer>(out, asked.size());
        device().destroy(target);
        device().destroy(out);
        device().destroy(places);
        device().destroy(block);
        return found;
    }

private:
    /// Returns the program. `rounds`: false: as if nothing rounded except a place that is rebuilt in float.
    gl::ProgramHandle program(bool rounds) {
        gl::ProgramHandle& held = programs_[rounds ? 1 : 0];
        if (held) return held;
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        const std::string probe =
            "#include \"lighting/gbuffer/surface_position_f64.glsl\"\n#include \"lighting/gbuffer/surface_position.glsl\"\n"
            "struct Asked { uvec4 place, pixel; };\n"
            "layout(std430, binding = 1) readonly buffer AskedBuffer { Asked asked[]; };\n"
            "layout(location = 0) out vec4 answer;\n"
            "void main() {\n"
            "    Asked one = asked[int(gl_FragCoord.x)];\n"
            "    SurfacePlace place = unpacked_place(one.place);\n"
            "    SeenPlace seen = seen_place(ivec2(one.pixel.xy), place);\n"
            "    dvec3 exact_ca = exact_place(ivec2(one.pixel.xy), place);\n"
            "    float error_m = " +
            std::string(rounds ? "seen.error_m" : "kRebuiltRelative * length(seen.position_ca)") +
            ";\n"
            "    answer = vec4(float(length(dvec3(seen.position_ca) - exact_ca)), error_m, place.interpolated_m, "
            "1.0);\n"
            "}\n";
        files.push_back({"probe.frag", probe});
        const auto vertex = gl::expand_shader(files, "common/fullscreen.vert", {});
        const auto fragment = gl::expand_shader(files, "probe.frag", {});
        EXPECT_TRUE(vertex && fragment);
        if (!vertex || !fragment) return {};
        return held = keep(device().create_program({"probe", vertex.value(), fragment.value()}));
    }
    gl::ProgramHandle programs_[2]{};
};

struct SeenTally {
    std::size_t places = 0, wrong = 0, known = 0, near = 0;
};

/// An error of a thousandth of a millimetre per metre matters to no texel.
constexpr float kOfNoMatter = 1.0e-6f;

SeenTally tally_of(const std::vector<Answer>& answers) {
    SeenTally tally;
    for (const Answer& a : answers) {
        EXPECT_EQ(a.looked, 1.0f);
        ++tally.places;
        tally.wrong += a.apart_m <= a.error_m ? 0 : 1;
        tally.known += a.error_m < 1.0e29f ? 1 : 0;
        tally.near += a.error_m <= 10.0f * kOfNoMatter * a.distance_m ? 1 : 0;
    }
    return tally;
}

TEST_F(SeenPlaces, AreOffByNoMoreThanTheySay) {
    Random random(print_seed());
    SeenTally sum, bare;
    for (int world = 0; world < 60; ++world) {
        const glm::dvec3 offset_m = chance(random, 0.2) ? glm::dvec3(1.0e8, -3.0e7, 5.0e7) : glm::dvec3(0.0);
        QueryScene scene = test::sheet_world(random, offset_m);
        const ConsumerItem camera = random_camera(random, offset_m);
        const auto seed = random();
        for (const bool rounds : {true, false}) {
            Random same(seed);
            const SeenTally tally = tally_of(answers(scene, camera, same, 2000, rounds));
            SeenTally& into = rounds ? sum : bare;
            into.places += tally.places;
            into.wrong += tally.wrong;
            into.known += tally.known;
            into.near += tally.near;
        }
    }
    std::cout << sum.places << " places, " << sum.known << " known, " << sum.near << " to 1e-5 of their distance; "
              << bare.wrong << " farther off than a place rebuilt from depth\n";
    EXPECT_GT(sum.places, 20000u);
    EXPECT_EQ(sum.wrong, 0u);
    EXPECT_GT(sum.known, sum.places * 3 / 4);  // needles have no plane to speak of
    EXPECT_GT(sum.near, sum.places / 2);
    EXPECT_GT(bare.wrong, 100u);  // so that the bound is needed
}

TEST_F(SeenPlaces, AreUncertainWhereRoundingDecidesWhetherThePlaneIsBelieved) {
    Random random(print_seed());
    SeenTally sum;
    for (int world = 0; world < 10; ++world) {
        QueryScene scene = test::sheet_world(random, glm::dvec3(0.0));
        const ConsumerItem camera = random_camera(random, glm::dvec3(0.0));
        const SeenTally tally = tally_of(answers(scene, camera, random, 2000, true, Interpolated::hardly));
        sum.places += tally.places;
        sum.wrong += tally.wrong;
        sum.known += tally.known;
    }
    std::cout << sum.places << " places, " << sum.known << " known\n";
    EXPECT_GT(sum.places, 500u);
    EXPECT_EQ(sum.wrong, 0u);
}

}  // namespace
}  // namespace gnomon
