#include "engine/assets/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <utility>

#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_extras.h"

namespace gnomon::assets::gltf {
namespace {

/// Largest outer cone angle, in double with the tolerance of a float: files round pi/2 to a float, which is above pi/2.
constexpr double kLargestCone_rad = glm::half_pi<double>() * (1.0 + 1e-7);
/// Near plane of a perspective camera with 0 or less in its file: a hundredth of the usual value in files in metres.
constexpr double kTakenNear_m = 1.0e-3;

class LightReader {
public:
    LightReader(Document& document, std::size_t index)
        : document_(document),
          source_(document.model.lights[index]),
          raw_(document.json["extensions"]["KHR_lights_punctual"]["lights"][index]),
          where_(pointer("extensions", "KHR_lights_punctual", "lights", index)) {}

    LightData read() {
        light_.name = source_.name;
        light_.type = source_.type == "directional" ? LightType::directional
                      : source_.type == "point"     ? LightType::point
                                                    : LightType::spot;
        light_.intensity = non_negative(source_.intensity, "light.intensity", "/intensity");
        for (std::size_t i = 0; i < source_.color.size(); ++i)
            light_.colour[static_cast<int>(i)] = non_negative(source_.color[i], "light.colour", "/color");
        if (raw_.contains("range")) read_range();
        if (light_.type == LightType::spot) read_cone();
        light_.casts_shadow = ExtrasReader(document_, raw_, where_).boolean("shadow", true);
        return std::move(light_);
    }

private:
    float non_negative(double value, const char* rule, const char* member) {
        const auto number = static_cast<float>(value);
        if (!std::isfinite(number)) fail(rule, where_ + member, "is beyond the range of a float");
        if (number >= 0.0f) return number;
        document_.take(rule, where_ + member, "is negative, taken as 0");
        return 0.0f;
    }

    void read_range() {
        const auto range_m = static_cast<float>(source_.range);
        if (range_m > 0.0f && std::isfinite(range_m))
            light_.range_m = range_m;
        else
            document_.take("light.range", where_ + "/range", "is no distance above 0, taken as no limit");
    }

    void read_cone() {
        const double inner = source_.spot.innerConeAngle, outer = source_.spot.outerConeAngle;
        if (inner >= 0.0 && inner < outer && outer <= kLargestCone_rad) {
            light_.inner_cone_rad = static_cast<float>(inner);
            light_.outer_cone_rad = static_cast<float>(outer);
            return;
        }
        const std::string at = where_ + "/spot";
        if (!(static_cast<float>(outer) > 0.0f)) {
            light_.intensity = 0.0f;
            document_.take("light.cone", at, "its outer cone is empty, so it lights nothing");
            return;
        }
        const double taken_outer = std::min(outer, glm::half_pi<double>());
        const double taken_inner = std::clamp(inner, 0.0, taken_outer);
        light_.outer_cone_rad = static_cast<float>(taken_outer);
        light_.inner_cone_rad = static_cast<float>(taken_inner);
        document_.take("light.cone", at,
                       "needs 0 <= inner < outer <= pi/2, taken as " + std::to_string(taken_inner) + " and " +
                           std::to_string(taken_outer));
    }

    Document& document_;
    const tinygltf::Light& source_;
    const nlohmann::json& raw_;
    std::string where_;
    LightData light_;
};

/// Reader of a light of EXT_lights_area, which tinygltf does not parse. Its size is the side of a square or the
/// diameter of a disc. Gnomon's own types have a sphere's diameter, or a tube's length.
class AreaLightReader {
public:
    AreaLightReader(Document& document, std::size_t index)
        : document_(document),
          raw_(document.json["extensions"]["EXT_lights_area"]["lights"][index]),
          where_(pointer("extensions", "EXT_lights_area", "lights", index)) {}

    LightData read() {
        const auto type = raw_.at("type").get<std::string>();
        light_.name = raw_.value("name", std::string());
        light_.type = type == "rect"     ? LightType::rectangle
                      : type == "disk"   ? LightType::disc
                      : type == "sphere" ? LightType::sphere
                                         : LightType::tube;
        light_.intensity = at_least(0.0, raw_, "intensity", 1.0f, "light.intensity");
        if (raw_.contains("color"))
            for (int i = 0; i < 3; ++i) light_.colour[i] = colour(i);
        const float size_m = at_least(kLeastSize_m, raw_, "size", 1.0f, "light.size");
        light_.width_m = light_.height_m = size_m;
        if (type == "rect" && raw_.contains("rect"))
            light_.width_m = size_m * at_least(kLeastSize_m, raw_["rect"], "aspect", 1.0f, "light.aspect");
        light_.radius_m = 0.5f * size_m;
        if (type == "tube") light_.radius_m = tube_radius(size_m);
        light_.casts_shadow = ExtrasReader(document_, raw_, where_).boolean("shadow", true);
        return std::move(light_);
    }

private:
    static constexpr double kLeastSize_m = 1.0e-6;  // a size of 0 or less: it gives no light that shows

    float at_least(double least, const nlohmann::json& of, const char* member, float otherwise, const char* rule) {
        if (!of.contains(member)) return otherwise;
        const auto number = of.at(member).get<float>();
        if (!std::isfinite(number)) fail(rule, where_ + "/" + member, "is beyond the range of a float");
        if (static_cast<double>(number) >= least) return number;
        document_.take(rule, where_ + "/" + member, "is too small, taken as " + std::to_string(least));
        return static_cast<float>(least);
    }

    float colour(int channel) {
        const auto number = raw_.at("color").at(static_cast<std::size_t>(channel)).get<float>();
        if (!std::isfinite(number)) fail("light.colour", where_ + "/color", "is beyond the range of a float");
        if (number >= 0.0f) return number;
        document_.take("light.colour", where_ + "/color", "is negative, taken as 0");
        return 0.0f;
    }

    float tube_radius(float length_m) {
        const float usual_m = 0.02f * length_m;  // a fluorescent tube's, by its length
        return raw_.contains("tube") ? at_least(kLeastSize_m, raw_["tube"], "radius", usual_m, "light.size") : usual_m;
    }

    Document& document_;
    const nlohmann::json& raw_;
    std::string where_;
    LightData light_;
};

/// Returns width by height of the frame; 0 with a warning if the file's value is invalid.
double frame_aspect(Document& document, double aspect, const std::string& where) {
    if (aspect > 0.0 && std::isfinite(aspect)) return aspect;
    document.take("camera.aspect", where, "is no ratio above 0, taken as the picture's");
    return 0.0;
}

std::optional<CameraData> load_perspective(Document& document, const tinygltf::PerspectiveCamera& source,
                                           const nlohmann::json& raw, const std::string& where) {
    if (!(source.yfov > 0.0 && source.yfov < glm::pi<double>())) {
        document.take("camera.fov", where + "/yfov", "must lie between 0 and pi; the camera is left out");
        return std::nullopt;
    }
    CameraData camera;
    camera.fov_y_rad = source.yfov;
    camera.near_m = source.znear;
    if (raw.contains("zfar")) camera.far_m = source.zfar;
    if (raw.contains("aspectRatio")) camera.aspect = frame_aspect(document, source.aspectRatio, where + "/aspectRatio");
    if (!(source.znear > 0.0) || !std::isfinite(source.znear)) {
        camera.near_m = camera.far_m > 0.0 ? std::min(kTakenNear_m, kTakenNear_m * camera.far_m) : kTakenNear_m;
        document.take("camera.near", where + "/znear", "must be above 0, taken as " + std::to_string(camera.near_m));
    }
    if (raw.contains("zfar") && !(camera.far_m > camera.near_m)) {
        camera.far_m = 0.0;
        document.take("camera.far", where + "/zfar", "must be above znear, taken as no end");
    }
    return camera;
}

std::optional<CameraData> load_orthographic(Document& document, const tinygltf::OrthographicCamera& source,
                                            const std::string& where) {
    const double half_width_m = std::abs(source.xmag), half_height_m = std::abs(source.ymag);
    const auto left_out = [&](const char* rule, const char* member, const char* reason) {
        document.take(rule, where + member, std::string(reason) + "; the camera is left out");
        return std::nullopt;
    };
    if (!(half_height_m > 0.0) || !std::isfinite(half_height_m))
        return left_out("camera.size", "/ymag", "must not be 0");
    if (!(source.zfar > source.znear) || !std::isfinite(source.zfar) || !std::isfinite(source.znear))
        return left_out("camera.far", "/zfar", "must be above znear");
    CameraData camera;
    camera.kind = CameraKind::orthographic;
    camera.half_height_m = half_height_m;
    camera.near_m = source.znear;
    camera.far_m = source.zfar;
    camera.aspect = frame_aspect(document, half_width_m / half_height_m, where + "/xmag");
    if (source.znear < 0.0)
        document.take("camera.near", where + "/znear", "is negative, taken as so far behind the camera");
    return camera;
}

}  // namespace

void load_lights(Document& document, SceneData& scene) {
    for (std::size_t i = 0; i < document.model.lights.size(); ++i)
        scene.lights.push_back(LightReader(document, i).read());
    const nlohmann::json::json_pointer area("/extensions/EXT_lights_area/lights");
    if (!document.json.contains(area)) return;
    for (std::size_t i = 0; i < document.json.at(area).size(); ++i)
        scene.lights.push_back(AreaLightReader(document, i).read());
}

std::vector<std::int32_t> load_cameras(Document& document, SceneData& scene) {
    std::vector<std::int32_t> became;
    for (std::size_t i = 0; i < document.model.cameras.size(); ++i) {
        const tinygltf::Camera& source = document.model.cameras[i];
        const bool perspective = source.type == "perspective";
        const std::string where = pointer("cameras", i, source.type);
        std::optional<CameraData> camera =
            perspective
                ? load_perspective(document, source.perspective, document.json["cameras"][i]["perspective"], where)
                : load_orthographic(document, source.orthographic, where);
        became.push_back(camera ? static_cast<std::int32_t>(scene.cameras.size()) : kNone);
        if (!camera) continue;
        camera->name = source.name;
        scene.cameras.push_back(std::move(*camera));
    }
    return became;
}

}  // namespace gnomon::assets::gltf
