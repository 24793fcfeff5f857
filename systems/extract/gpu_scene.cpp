#include "systems/extract/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "engine/math/projection.h"
#include "systems/growing_buffer.h"

namespace gnomon {
namespace {

std::vector<glm::vec4> plane_normals(const assets::MeshLibrary& library) {
    std::vector<glm::vec4> normals;
    for (const assets::Mesh& mesh : library.meshes) append_plane_normals(mesh.vertices, mesh.indices, normals);
    return normals;
}

/// Returns a colour per vertex of the library; empty if no mesh has colours.
std::vector<glm::vec4> vertex_colours(const assets::MeshLibrary& library) {
    std::vector<glm::vec4> colours;
    const bool any = std::any_of(library.meshes.begin(), library.meshes.end(),
                                 [](const assets::Mesh& mesh) { return !mesh.colours.empty(); });
    if (!any) return colours;
    for (const assets::Mesh& mesh : library.meshes) {
        const std::size_t first = colours.size();
        colours.insert(colours.end(), mesh.colours.begin(), mesh.colours.end());
        colours.resize(first + mesh.vertices.size(), glm::vec4(1.0f));
    }
    return colours;
}

gl::Wrap wrap(assets::TextureWrap w) {
    switch (w) {
        case assets::TextureWrap::repeat:
            return gl::Wrap::repeat;
        case assets::TextureWrap::mirror:
            return gl::Wrap::mirror;
        case assets::TextureWrap::clamp:
            return gl::Wrap::clamp;
    }
    return gl::Wrap::repeat;
}

MaterialRecord material_record(const assets::Material& m) {
    MaterialRecord r{};
    // A library filled in by hand may contain any value; NaN and negative values become 0.
    const auto within = [](float value, float most) { return value > 0.0f ? std::min(value, most) : 0.0f; };
    constexpr float kMost = 1.0e30f;
    for (int i = 0; i < 4; ++i) r.base_colour[i] = within(m.base_colour[i], kMost);
    for (int i = 0; i < 3; ++i) r.emissive[i] = within(m.emissive[i], kMost);
    r.emissive[3] = m.unlit ? 1.0f : 0.0f;
    r.metallic = within(m.metallic, 1.0f);
    r.roughness = within(m.roughness, 1.0f);
    r.alpha_cutoff = m.alpha_mode == assets::AlphaMode::mask ? m.alpha_cutoff : -1.0f;
    r.has_texture = m.base_colour_texture != assets::kNone ? 1.0f : 0.0f;
    return r;
}

InstanceRecord instance_record(const InstanceItem& item) {
    const math::TwoFloat3 t = math::split(item.translation_ws_m);
    const auto column = [&](int i, float(&out)[4]) {
        for (int row = 0; row < 3; ++row) out[row] = static_cast<float>(item.basis[i][row]);
        out[3] = t.high[i];
    };
    InstanceRecord r{};
    column(0, r.basis_x_high_x);
    column(1, r.basis_y_high_y);
    column(2, r.basis_z_high_z);
    for (int i = 0; i < 3; ++i) r.low_layers[i] = t.low[i];
    const int received = item.receives ? item.receive_layers : 0, cast = item.casts ? item.cast_layers : 0;
    r.low_layers[3] = static_cast<float>(received + 256 * cast);
    return r;
}

template <class T>
gl::Created<gl::BufferHandle> filled_buffer(gl::Device& device, const char* label, const std::vector<T>& values,
                                            gl::BufferUse use = gl::BufferUse::fixed, bool texels = false) {
    static const T kNothing{};  // a buffer must have a size; nothing of an empty library is drawn from it
    const auto bytes = values.empty() ? std::as_bytes(std::span(&kNothing, 1)) : std::as_bytes(std::span(values));
    return device.create_buffer({label, bytes.size(), use, texels}, bytes);
}

/// Returns the use of buffers with shapes: they change only if some mesh is deformable.
gl::BufferUse shape_use(const assets::MeshLibrary& library) {
    const bool bends = std::any_of(library.meshes.begin(), library.meshes.end(),
                                   [](const assets::Mesh& mesh) { return mesh.deformer != nullptr; });
    return bends ? gl::BufferUse::updated : gl::BufferUse::fixed;
}

/// Packs the residual of a unit normal rounded to float: at most half a unit of 2^-24 along each axis.
float packed_residual(const glm::dvec3& exact, const glm::vec3& rounded) {
    constexpr int kBits = 10, kMost = (1 << (kBits - 1)) - 1;
    constexpr double kStep = 0x1p-25 / kMost;
    std::uint32_t bits = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double off = (exact[axis] - static_cast<double>(rounded[axis])) / kStep;
        const auto steps = std::clamp(static_cast<int>(std::lround(off)), -kMost, kMost);
        bits |= (static_cast<std::uint32_t>(steps) & ((1u << kBits) - 1u)) << (kBits * axis);
    }
    return std::bit_cast<float>(bits);
}

}  // namespace

void append_plane_normals(std::span<const assets::Vertex> vertices, std::span<const std::uint32_t> indices,
                          std::vector<glm::vec4>& normals) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a(vertices[indices[i]].position_ms);
        const glm::dvec3 b(vertices[indices[i + 1]].position_ms);
        const glm::dvec3 c(vertices[indices[i + 2]].position_ms);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double size = glm::length(n);
        const glm::dvec3 unit = size > 0.0 ? n / size : glm::dvec3(0.0);
        const glm::vec3 rounded(unit);
        normals.emplace_back(rounded, packed_residual(unit, rounded));
    }
}

float most_reflected(const assets::Material& material) {
    if (material.unlit) return 0.0f;
    constexpr float kLeastAlpha = 1.0e-3f;  // as in brdf.glsl
    const float alpha = std::max(material.roughness * material.roughness, kLeastAlpha);
    const float colour = std::max({material.base_colour.r, material.base_colour.g, material.base_colour.b});
    const float diffuse = std::max(colour * (1.0f - material.metallic), 0.0f) / glm::pi<float>();
    const float fresnel = std::max(colour, 1.0f);
    return diffuse + fresnel / (2.0f * glm::pi<float>() * alpha * alpha * alpha);
}

Result<GpuScene> GpuScene::create(gl::Device& device, const assets::MeshLibrary& library) {
    GpuScene scene;
    scene.device_ = &device;
    scene.library_ = &library;
    const auto failed = [](const char* what, gl::Failure failure) {
        return Error{
            std::string("the GPU could not hold ") + what + " (" + gl::to_text(failure) + ")", {}, {}, "gpu.scene"};
    };

    std::vector<assets::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    for (const assets::Mesh& mesh : library.meshes) {
        MeshRange range;
        range.base_vertex = static_cast<std::int32_t>(vertices.size());
        range.first_index = static_cast<std::uint32_t>(indices.size());
        range.first_submesh = static_cast<std::uint32_t>(scene.submeshes_.size());
        range.submesh_count = static_cast<std::uint32_t>(mesh.submeshes.size());
        range.triangles = mesh.indices.size() / 3;
        range.solid = mesh.topology.outward;
        for (const assets::Submesh& s : mesh.submeshes) {
            scene.submeshes_.push_back({range.first_index + s.first_index, s.index_count, s.material});
            const assets::Material& material = library.materials[s.material];
            range.most_reflected = std::max(range.most_reflected, most_reflected(material));
            range.solid = range.solid && material.alpha_mode == assets::AlphaMode::opaque && !material.double_sided;
        }
        if (mesh.deformer) scene.bent_.push_back({static_cast<std::uint32_t>(scene.meshes_.size()), 0, mesh.vertices});
        scene.meshes_.push_back(range);
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    const auto keep = [](auto& slot, auto created) {
        slot = created.handle;
        return created.failure;
    };
    const gl::BufferUse use = shape_use(library);
    gl::Failure f = keep(scene.vertices_, filled_buffer(device, "scene vertices", vertices, use, true));
    if (f == gl::Failure::none) f = keep(scene.indices_, filled_buffer(device, "scene indices", indices));
    if (f == gl::Failure::none)
        f = keep(scene.triangle_normals_, filled_buffer(device, "triangle normals", plane_normals(library), use, true));
    const std::vector<glm::vec4> colours = vertex_colours(library);
    if (f == gl::Failure::none && !colours.empty())
        f = keep(scene.colours_, filled_buffer(device, "vertex colours", colours, gl::BufferUse::fixed, true));
    if (f != gl::Failure::none) return failed("the scene's meshes", f);

    const std::uint32_t stride = aligned(sizeof(MaterialRecord), device.info().uniform_alignment);
    std::vector<std::byte> materials(std::max<std::size_t>(library.materials.size(), 1) * stride);
    for (std::size_t m = 0; m < library.materials.size(); ++m) {
        const MaterialRecord record = material_record(library.materials[m]);
        std::memcpy(materials.data() + m * stride, &record, sizeof record);
    }
    f = keep(scene.material_uniforms_, filled_buffer(device, "materials", materials));
    if (f != gl::Failure::none) return failed("the scene's materials", f);

    const std::uint8_t kWhite[4] = {255, 255, 255, 255};
    const auto add_texture = [&](const gl::TextureDesc& desc, std::span<const std::uint8_t> pixels) {
        const auto made = device.create_texture(desc, std::as_bytes(pixels));
        if (made) scene.textures_.push_back(made.handle);
        return made.failure;
    };
    f = add_texture({"white", gl::TextureKind::flat, gl::Format::srgb8_a8, 1, 1, 1, 1}, kWhite);
    for (const assets::Texture& t : library.textures) {
        if (f != gl::Failure::none) break;
        f = add_texture({"texture " + t.name, gl::TextureKind::flat, gl::Format::srgb8_a8, t.width, t.height, 1, 0},
                        t.rgba);
    }
    if (f != gl::Failure::none) return failed("the scene's textures", f);

    std::map<std::tuple<assets::TextureWrap, assets::TextureWrap, bool>, gl::SamplerHandle> samplers;
    const auto sampler_for = [&](assets::TextureWrap u, assets::TextureWrap v, bool linear) {
        auto& sampler = samplers[{u, v, linear}];
        if (!sampler) {
            const auto made = device.create_sampler({"scene texture", linear, linear, false, wrap(u), wrap(v)});
            if (!made) f = made.failure;
            sampler = made.handle;
            scene.samplers_.push_back(sampler);
        }
        return sampler;
    };
    for (std::size_t m = 0; m < library.materials.size(); ++m) {
        const assets::Material& material = library.materials[m];
        MaterialInfo info;
        info.uniform_offset = static_cast<std::uint32_t>(m) * stride;
        info.alpha_mode = material.alpha_mode;
        info.double_sided = material.double_sided;
        info.unlit = material.unlit;
        scene.any_unlit_ |= material.unlit;
        for (int i = 0; i < 3 && !material.unlit; ++i)
            scene.most_emissive_ = std::max(scene.most_emissive_, material.emissive[i]);
        const auto t = material.base_colour_texture;
        info.texture = scene.textures_[t == assets::kNone ? 0 : static_cast<std::size_t>(t) + 1];
        info.sampler = t == assets::kNone ? sampler_for(assets::TextureWrap::repeat, assets::TextureWrap::repeat, false)
                                          : sampler_for(library.textures[t].wrap_u, library.textures[t].wrap_v,
                                                        library.textures[t].linear_filter);
        scene.materials_.push_back(info);
    }
    if (f != gl::Failure::none) return failed("the scene's samplers", f);
    return scene;
}

bool GpuScene::provide_caster_triangles() {
    if (caster_triangles_ || !triangles_retry_.due(++triangles_asked_)) return static_cast<bool>(caster_triangles_);
    CasterTriangleList made = caster_triangles_of(*library_);
    triangle_records_ = std::move(made.triangles);
    for (const Bent& bent : bent_) put_corners(bent);
    caster_triangles_ =
        filled_buffer(*device_, "caster triangles", triangle_records_, shape_use(*library_), true).handle;
    if (caster_triangles_ && !made.masks.empty()) {
        caster_masks_ = filled_buffer(*device_, "caster masks", made.masks).handle;
        if (!caster_masks_) device_->destroy(std::exchange(caster_triangles_, {}));
    }
    if (!caster_triangles_) triangles_retry_.failed(triangles_asked_);
    if (!caster_triangles_ || bent_.empty()) triangle_records_ = {};
    return static_cast<bool>(caster_triangles_);
}

GpuScene::GpuScene(GpuScene&& other) noexcept { *this = std::move(other); }

GpuScene& GpuScene::operator=(GpuScene&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = std::exchange(other.device_, nullptr);
    vertices_ = std::exchange(other.vertices_, {});
    indices_ = std::exchange(other.indices_, {});
    instances_ = std::exchange(other.instances_, {});
    triangle_normals_ = std::exchange(other.triangle_normals_, {});
    material_uniforms_ = std::exchange(other.material_uniforms_, {});
    caster_triangles_ = std::exchange(other.caster_triangles_, {});
    caster_masks_ = std::exchange(other.caster_masks_, {});
    colours_ = std::exchange(other.colours_, {});
    bent_ = std::move(other.bent_);
    triangle_records_ = std::move(other.triangle_records_);
    library_ = other.library_;
    any_unlit_ = other.any_unlit_;
    most_emissive_ = other.most_emissive_;
    triangles_retry_ = other.triangles_retry_;
    triangles_asked_ = other.triangles_asked_;
    instance_capacity_ = std::exchange(other.instance_capacity_, 0);
    upload_all_ = std::exchange(other.upload_all_, false);
    records_ = std::move(other.records_);
    textures_ = std::move(other.textures_);
    samplers_ = std::move(other.samplers_);
    meshes_ = std::move(other.meshes_);
    submeshes_ = std::move(other.submeshes_);
    materials_ = std::move(other.materials_);
    other.textures_.clear();
    other.samplers_.clear();
    return *this;
}

GpuScene::~GpuScene() { release(); }

void GpuScene::release() {
    if (!device_) return;
    for (const gl::BufferHandle b : {vertices_, indices_, instances_, triangle_normals_, material_uniforms_,
                                     caster_triangles_, caster_masks_, colours_})
        device_->destroy(b);
    for (const gl::TextureHandle t : textures_) device_->destroy(t);
    for (const gl::SamplerHandle s : samplers_) device_->destroy(s);
    device_ = nullptr;
}

bool GpuScene::update(const SceneSnapshot& snapshot, gl::CommandList& list) {
    update_instances(snapshot, list);
    update_poses(snapshot, list);
    return snapshot.gpu_slot_count <= instance_capacity_;
}

GpuScene::MeshShape GpuScene::shape(std::uint32_t mesh) const {
    const assets::Mesh& rest = library_->meshes[mesh];
    const auto bent = std::find_if(bent_.begin(), bent_.end(), [&](const Bent& b) { return b.mesh == mesh; });
    if (bent == bent_.end()) return {&rest.vertices, &rest.indices, 0};
    return {&bent->vertices, &rest.indices, bent->version};
}

void GpuScene::forget_uploads() {
    upload_all_ = true;
    for (Bent& bent : bent_) bent.version = kUnknown;
}

/// Writes the mesh's bent corners into the library's triangle records.
void GpuScene::put_corners(const Bent& bent) {
    const std::vector<std::uint32_t>& indices = library_->meshes[bent.mesh].indices;
    CasterTriangle* first = triangle_records_.data() + meshes_[bent.mesh].first_index / 3;
    for (std::size_t i = 0; i < indices.size() / 3 * 3; ++i)
        first[i / 3].corners[i % 3].position_ms = bent.vertices[indices[i]].position_ms;
}

void GpuScene::upload(const Bent& bent, gl::CommandList& list) {
    const MeshRange& range = meshes_[bent.mesh];
    const std::uint64_t first_triangle = range.first_index / 3;
    list.update(vertices_, static_cast<std::uint64_t>(range.base_vertex) * sizeof(assets::Vertex),
                std::span<const assets::Vertex>(bent.vertices));
    normal_scratch_.clear();
    append_plane_normals(bent.vertices, library_->meshes[bent.mesh].indices, normal_scratch_);
    list.update(triangle_normals_, first_triangle * sizeof(glm::vec4), std::span<const glm::vec4>(normal_scratch_));
    if (!caster_triangles_) return;
    put_corners(bent);
    list.update(caster_triangles_, first_triangle * sizeof(CasterTriangle),
                std::span<const CasterTriangle>(triangle_records_)
                    .subspan(static_cast<std::size_t>(first_triangle), static_cast<std::size_t>(range.triangles)));
}

void GpuScene::update_poses(const SceneSnapshot& snapshot, gl::CommandList& list) {
    for (Bent& bent : bent_) {
        const PoseItem* pose = pose_of(snapshot, bent.mesh);
        const std::uint64_t wanted = pose ? pose->version : 0;
        if (bent.version == wanted) continue;
        if (pose)
            assets::deform(library_->meshes[bent.mesh], pose->pose(), bent.vertices);
        else
            bent.vertices = library_->meshes[bent.mesh].vertices;
        bent.version = wanted;
        upload(bent, list);
    }
}

void GpuScene::update_instances(const SceneSnapshot& snapshot, gl::CommandList& list) {
    records_.resize(snapshot.gpu_slot_count);
    const std::uint64_t most = device_->info().max_texel_bytes / sizeof(InstanceRecord);
    if (snapshot.gpu_slot_count > instance_capacity_ && instance_capacity_ < most) {
        const auto wanted = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(std::bit_ceil(std::uint64_t{snapshot.gpu_slot_count}), most));
        const std::uint64_t bytes = std::uint64_t{wanted} * sizeof(InstanceRecord);
        const auto made = device_->create_buffer({"instances", bytes, gl::BufferUse::updated, true}, {});
        if (made) {
            device_->destroy(instances_);
            instances_ = made.handle;
            instance_capacity_ = wanted;
            upload_all_ = true;
        }
    }
    const std::size_t held = std::min<std::size_t>(records_.size(), instance_capacity_);
    if (upload_all_) {
        for (const InstanceItem& item : snapshot.instances) records_[item.gpu_slot] = instance_record(item);
        list.update(instances_, 0, std::span<const InstanceRecord>(records_).first(held));
        upload_all_ = false;
    } else {
        // Sorted by slot; each run of neighbours is one copy.
        const auto& changed = snapshot.changed_instances;
        const auto slot = [&](std::size_t i) { return snapshot.instances[changed[i]].gpu_slot; };
        for (std::size_t first = 0; first < changed.size();) {
            std::size_t end = first;
            do {
                records_[slot(end)] = instance_record(snapshot.instances[changed[end]]);
                ++end;
            } while (end < changed.size() && slot(end) == slot(end - 1) + 1);
            const std::size_t from = slot(first), to = std::min(held, from + (end - first));
            if (from < to)
                list.update(instances_, std::uint64_t{from} * sizeof(InstanceRecord),
                            std::span<const InstanceRecord>(records_).subspan(from, to - from));
            first = end;
        }
    }
}

}  // namespace gnomon
