#include "systems/extract/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <string>

#include "engine/math/projection.h"
#include "systems/extract/depth_runs.h"

namespace gnomon {
namespace {

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

}  // namespace

Result<GpuScene> GpuScene::create(gl::Device& device, const assets::MeshLibrary& library) {
    GpuScene scene;
    scene.device_ = &device;
    const auto failed = [](const char* what, gl::Failure failure) {
        return Error{
            std::string("the GPU could not hold ") + what + " (" + gl::to_text(failure) + ")", {}, {}, "gpu.scene"};
    };
    const gl::Failure meshes = scene.meshes_.create(device, library);
    if (meshes != gl::Failure::none) return failed("the scene's meshes", meshes);
    const SceneMaterials::Failed materials = scene.materials_.create(device, library);
    if (materials.failure != gl::Failure::none) return failed(materials.what, materials.failure);
    scene.update_depth_facts();
    return scene;
}

GpuScene& GpuScene::operator=(GpuScene&& other) noexcept {
    if (this == &other) return *this;
    release();
    device_ = std::exchange(other.device_, nullptr);
    meshes_ = std::move(other.meshes_);
    materials_ = std::move(other.materials_);
    instances_ = std::exchange(other.instances_, {});
    instance_capacity_ = std::exchange(other.instance_capacity_, 0);
    upload_all_ = std::exchange(other.upload_all_, false);
    records_ = std::move(other.records_);
    depth_facts_ = std::move(other.depth_facts_);
    seen_materials_ = std::exchange(other.seen_materials_, 0);
    return *this;
}

void GpuScene::release() {
    if (device_) device_->destroy(instances_);
    device_ = nullptr;
}

void GpuScene::update_meshes(gl::CommandList& list) {
    materials_.follow(list);
    meshes_.follow(materials_, list);
    update_depth_facts();
}

void GpuScene::put_engine_mesh(std::uint32_t mesh, const EngineMesh& of) {
    meshes_.put_engine_mesh(mesh, of);
    update_depth_facts();
}

/// Makes facts of the meshes that came or went; of all, if some material did.
void GpuScene::update_depth_facts() {
    depth_facts_.resize(meshes_.count());
    const bool all = std::exchange(seen_materials_, materials_.version()) != materials_.version();
    for (std::uint32_t m = 0; all && m < depth_facts_.size(); ++m) depth_facts_[m] = make_depth_facts(m);
    for (const std::uint32_t m : meshes_.changed())
        if (!all) depth_facts_[m] = make_depth_facts(m);
    meshes_.forget_changed();
}

MeshDepthFacts GpuScene::make_depth_facts(std::uint32_t mesh) const {
    const MeshRange& range = meshes_.mesh(mesh);
    MeshDepthFacts facts;
    facts.solid = range.solid;
    facts.base_vertex = range.base_vertex;
    for (std::uint32_t s = 0; s < range.submesh_count; ++s) {
        const std::uint32_t material = submesh(range.first_submesh + s).material;
        if (material >= materials_.count()) return {};  // a mesh that no snapshot may list
        facts.masked |= materials_.material(material).alpha_mode == assets::AlphaMode::mask;
    }
    DepthRun only;
    for_each_depth_run(*this, mesh, [&](const DepthRun& run) {
        only = run;
        ++facts.draws;
    });
    if (facts.draws == 1 && only.mask == nullptr && only.engine == nullptr) {
        facts.first_index = only.first_index;
        facts.index_count = only.index_count;
    }
    return facts;
}

bool GpuScene::update(const SceneSnapshot& snapshot, gl::CommandList& list) {
    update_instances(snapshot, list);
    meshes_.update_poses(snapshot, list);
    return snapshot.gpu_slot_count <= instance_capacity_;
}

void GpuScene::submitted(bool executed) {
    meshes_.submitted(executed);
    materials_.submitted(executed);
    upload_all_ |= !executed;
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
    const std::size_t count = std::min<std::size_t>(records_.size(), instance_capacity_);
    if (upload_all_) {
        for (const InstanceItem& item : snapshot.instances) records_[item.gpu_slot] = instance_record(item);
        list.update(instances_, 0, std::span<const InstanceRecord>(records_).first(count));
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
            const std::size_t from = slot(first), to = std::min(count, from + (end - first));
            if (from < to)
                list.update(instances_, std::uint64_t{from} * sizeof(InstanceRecord),
                            std::span<const InstanceRecord>(records_).subspan(from, to - from));
            first = end;
        }
    }
}

}  // namespace gnomon
