#include "gnomon/assets.h"

#include <exception>
#include <new>
#include <utility>

#include "engine/assets/gltf_animations.h"
#include "engine/assets/gltf_document.h"
#include "engine/assets/gltf_error.h"
#include "engine/assets/gltf_file.h"
#include "engine/assets/gltf_lights.h"
#include "engine/assets/gltf_limits.h"
#include "engine/assets/gltf_materials.h"
#include "engine/assets/gltf_mesh.h"
#include "engine/assets/gltf_nodes.h"
#include "engine/assets/gltf_skins.h"

namespace gnomon::assets {
namespace {

SceneData load_scene(std::span<const std::byte> bytes, const std::filesystem::path& folder, const std::string& name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    gltf::Document document = gltf::parse_document(bytes, folder, extension == ".glb" || extension == ".GLB");
    SceneData scene;
    scene.name = std::filesystem::path(name).stem().string();
    const std::vector<gltf::UvSource> uv_sources = gltf::load_materials(document, scene);
    const std::vector<gltf::MeshPlace> places = gltf::load_meshes(document, uv_sources, scene);
    gltf::load_lights(document, scene);
    const std::vector<std::int32_t> cameras = gltf::load_cameras(document, scene);
    const std::vector<std::int32_t> scene_nodes = gltf::load_nodes(document, cameras, places, scene);
    gltf::load_skins(document, scene_nodes, scene);
    gltf::load_animations(document, scene_nodes, scene);
    gltf::warn_of_blended_casters(document, scene);
    scene.warnings = std::move(document.warnings);
    if (document.suppressed_warnings > 0) {
        scene.warnings.push_back(std::to_string(document.suppressed_warnings) + " more warnings");
    }
    return scene;
}

/// Runs the loader and turns all exceptions, including those of its libraries, into an Error.
template <class Load>
Result<SceneData> guarded(const std::string& file, Load&& load) {
    Error error;
    try {
        return load();
    } catch (gltf::Failure& failure) {
        error = std::move(failure.error);
    } catch (const std::bad_alloc&) {
        error = {"not enough memory to load it", {}, {}, "memory.exhausted"};
    } catch (const std::exception& unexpected) {
        error = {gltf::printable(unexpected.what()), {}, {}, "gltf.parse"};
    }
    error.file = file;
    return error;
}

}  // namespace

Result<SceneData> load_gltf(const std::filesystem::path& file) {
    return guarded(file.string(), [&] {
        const gltf::Bytes bytes = gltf::read_file(file, gltf::kMaxFileBytes, "");
        const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
        return load_scene(bytes, folder, file.filename().string());
    });
}

Result<SceneData> load_gltf_memory(std::span<const std::byte> bytes, const std::filesystem::path& base_folder,
                                   const std::string& name) {
    return guarded(name, [&] {
        if (bytes.size() > gltf::kMaxFileBytes) gltf::fail("file.too_large", "", "more bytes than are read");
        return load_scene(bytes, base_folder, name);
    });
}

}  // namespace gnomon::assets
