#include "engine/assets/gltf_lights.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_extras.h"

namespace gnomon::assets::gltf {
namespace {

float non_negative(double value, const char* rule, const std::string& pointer) {
    const auto number = static_cast<float>(value);
    if (!std::isfinite(number) || !(number >= 0.0f)) fail(rule, pointer, "must be finite and not negative");
    return number;
}

void read_cone(const tinygltf::Light& source, const std::string& where, LightData& light) {
    light.inner_cone_rad = static_cast<float>(source.spot.innerConeAngle);
    light.outer_cone_rad = static_cast<float>(source.spot.outerConeAngle);
    // In double, and with the tolerance of a float: files write pi/2 rounded to a float, which is above pi/2.
    constexpr double kLargestCone_rad = glm::half_pi<double>() * (1.0 + 1e-7);
    const bool ordered = source.spot.innerConeAngle >= 0.0 && source.spot.innerConeAngle < source.spot.outerConeAngle &&
                         source.spot.outerConeAngle <= kLargestCone_rad;
    if (!ordered || !(light.inner_cone_rad < light.outer_cone_rad)) {
        fail("light.cone", where + "/spot", "needs 0 <= inner < outer <= pi/2");
    }
}

LightData load_light(Document& document, std::size_t index) {
    const tinygltf::Light& source = document.model.lights[index];
    const auto& raw = document.json["extensions"]["KHR_lights_punctual"]["lights"][index];
    const std::string where = pointer("extensions", "KHR_lights_punctual", "lights", index);
    LightData light;
    light.name = source.name;
    if (source.type == "directional") {
        light.type = LightType::directional;
    } else if (source.type == "point") {
        light.type = LightType::point;
    } else {
        light.type = LightType::spot;
        read_cone(source, where, light);
    }
    light.intensity = non_negative(source.intensity, "light.intensity", where + "/intensity");
    light.range_m = non_negative(source.range, "light.range", where + "/range");
    if (raw.contains("range") && !(light.range_m > 0.0f)) fail("light.range", where + "/range", "must be above 0");
    for (std::size_t i = 0; i < source.color.size(); ++i) {
        light.colour[static_cast<int>(i)] = non_negative(source.color[i], "light.colour", where + "/color");
    }
    light.casts_shadow = ExtrasReader(document, raw, where).boolean("shadow", true);
    return light;
}

CameraData load_perspective(const tinygltf::PerspectiveCamera& source, const nlohmann::json& raw,
                            const std::string& where) {
    if (!(source.yfov > 0.0 && source.yfov < glm::pi<double>())) {
        fail("camera.fov", where + "/yfov", "must lie between 0 and pi");
    }
    if (!(source.znear > 0.0) || !std::isfinite(source.znear)) fail("camera.near", where + "/znear", "must be above 0");
    const bool has_far = raw.contains("zfar");
    if (has_far && !(source.zfar > source.znear)) fail("camera.far", where + "/zfar", "must be above znear");
    CameraData camera;
    camera.fov_y_rad = source.yfov;
    camera.near_m = source.znear;
    camera.far_m = has_far ? source.zfar : 0.0;
    return camera;
}

CameraData load_orthographic(const tinygltf::OrthographicCamera& source, const std::string& where) {
    const double half_height_m = std::abs(source.ymag);
    if (!(half_height_m > 0.0) || !std::isfinite(half_height_m)) fail("camera.size", where + "/ymag", "must not be 0");
    if (!(source.znear >= 0.0)) fail("camera.near", where + "/znear", "must not be negative");
    if (!(source.zfar > source.znear)) fail("camera.far", where + "/zfar", "must be above znear");
    CameraData camera;
    camera.kind = CameraKind::orthographic;
    camera.half_height_m = half_height_m;
    camera.near_m = source.znear;
    camera.far_m = source.zfar;
    return camera;
}

}  // namespace

void load_lights(Document& document, SceneData& scene) {
    for (std::size_t i = 0; i < document.model.lights.size(); ++i) scene.lights.push_back(load_light(document, i));
}

void load_cameras(const Document& document, SceneData& scene) {
    for (std::size_t i = 0; i < document.model.cameras.size(); ++i) {
        const tinygltf::Camera& source = document.model.cameras[i];
        const bool perspective = source.type == "perspective";
        const std::string where = pointer("cameras", i, source.type);
        CameraData camera =
            perspective ? load_perspective(source.perspective, document.json["cameras"][i]["perspective"], where)
                        : load_orthographic(source.orthographic, where);
        camera.name = source.name;
        scene.cameras.push_back(std::move(camera));
    }
}

}  // namespace gnomon::assets::gltf
