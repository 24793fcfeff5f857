#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/gl/device_recording.h"
#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {

constexpr std::uint64_t kVertexBytes = 32;  // layout "mesh" of BindMeshes
constexpr std::uint64_t kItemBytes = 2 * sizeof(std::uint32_t);

struct Size {
    std::uint32_t width = 0, height = 0;
};

/// State while walking a list, with one operator() per command.
class ListChecker {
public:
    ListChecker(const CommandList& list, std::uint64_t submission, const DeviceInfo& info, RecordedObjects& objects,
                std::vector<Finding>& findings)
        : list_(list), submission_(submission), info_(info), objects_(objects), findings_(findings) {}

    std::vector<std::uint32_t> run() {
        for (index_ = 0; index_ < list_.commands.size(); ++index_) std::visit(*this, list_.commands[index_]);
        if (in_pass_) find(Misuse::unbalanced_pass, "list ends inside a pass");
        if (open_groups_ != 0) find(Misuse::unbalanced_group, "list ends inside a group");
        if (timer_) find(Misuse::unbalanced_timer, "list ends inside a timer");
        return std::move(timers_);
    }

    void operator()(const BeginGroup&) { ++open_groups_; }
    void operator()(const EndGroup&) {
        if (open_groups_ == 0) return find(Misuse::unbalanced_group, "no group is open");
        --open_groups_;
    }

    void operator()(const BeginPass& c) {
        if (in_pass_) find(Misuse::nested_pass, "a pass is open");
        in_pass_ = true;
        target_ = c.target;
        if (known_target(c.target)) check_rect(c.target, c.viewport);
    }
    void operator()(const EndPass&) {
        if (!in_pass_) find(Misuse::unbalanced_pass, "no pass is open");
        in_pass_ = false;
    }

    void operator()(const SetScissor& c) {
        if (c.rect.width < 0 || c.rect.height < 0) find(Misuse::viewport_out_of_target, "negative size");
    }
    void operator()(const SetPipeline& c) {
        has_pipeline_ = known(objects_.programs, c.state.program.id, "program");
        writes_depth_ = c.state.depth_write;
        if (has_pipeline_ && computes(c.state.program)) find(Misuse::wrong_program, "a compute program cannot draw");
    }
    void operator()(const BindTexture& c) {
        textures_.erase(c.unit);
        if (!c.texture) return;  // unbinds
        if (known(objects_.textures, c.texture.id, "texture")) textures_[c.unit] = c.texture;
        if (c.sampler) known(objects_.samplers, c.sampler.id, "sampler");
    }
    void operator()(const BindUniforms& c) {
        if (!known(objects_.buffers, c.buffer.id, "buffer")) return;
        if (info_.uniform_alignment != 0 && c.offset % info_.uniform_alignment != 0) {
            find(Misuse::uniform_misaligned, "offset " + std::to_string(c.offset));
        }
        if (c.size == 0 || !in_range(c.offset, c.size, objects_.buffers.at(c.buffer.id).desc.size)) {
            find(Misuse::uniform_out_of_range, "the buffer is smaller, or size is 0");
        }
    }
    void operator()(const BindStorage& c) { known(objects_.buffers, c.buffer.id, "buffer"); }

    void operator()(const BindTexels& c) {
        textures_.erase(c.unit);
        if (!known(objects_.buffers, c.buffer.id, "buffer")) return;
        const BufferDesc& desc = objects_.buffers.at(c.buffer.id).desc;
        if (!desc.texels) find(Misuse::buffer_without_texels, desc.label);
    }

    void operator()(const UpdateBuffer& c) {
        if (in_pass_) find(Misuse::update_inside_pass, "a pass is open");
        if (!known(objects_.buffers, c.buffer.id, "buffer")) return;
        RecordedBuffer& buffer = objects_.buffers.at(c.buffer.id);
        if (buffer.desc.use != BufferUse::updated) return find(Misuse::update_of_fixed_buffer, buffer.desc.label);
        if (!in_range(c.offset, c.size, buffer.bytes.size()) || !in_range(c.first, c.size, list_.bytes.size())) {
            return find(Misuse::update_out_of_range, buffer.desc.label);
        }
        std::copy_n(list_.bytes.begin() + static_cast<std::ptrdiff_t>(c.first), c.size,
                    buffer.bytes.begin() + static_cast<std::ptrdiff_t>(c.offset));
    }

    void operator()(const ClearBuffer& c) {
        if (in_pass_) find(Misuse::update_inside_pass, "a pass is open");
        if (!known(objects_.buffers, c.buffer.id, "buffer")) return;
        RecordedBuffer& buffer = objects_.buffers.at(c.buffer.id);
        if (buffer.desc.use != BufferUse::updated) return find(Misuse::update_of_fixed_buffer, buffer.desc.label);
        if (c.offset % 4 != 0 || c.size % 4 != 0 || !in_range(c.offset, c.size, buffer.bytes.size()))
            return find(Misuse::update_out_of_range, buffer.desc.label);
        std::fill_n(buffer.bytes.begin() + static_cast<std::ptrdiff_t>(c.offset), c.size, std::byte{0});
    }

    void operator()(const BindMeshes& c) {
        const bool vertices = known(objects_.buffers, c.vertices.id, "vertices");
        const bool indices = known(objects_.buffers, c.indices.id, "indices");
        const bool items = known(objects_.buffers, c.draw_items.id, "draw_items");
        has_meshes_ = vertices && indices && items;
        meshes_ = c;
    }
    void operator()(const DrawMeshes& c) {
        check_draw();
        check_mesh_draw(c);
    }
    void operator()(const DrawMeshesIndirect& c) {
        check_draw();
        if (!known(objects_.buffers, c.records.id, "records")) return;
        const RecordedBuffer& records = objects_.buffers.at(c.records.id);
        if (records.desc.use != BufferUse::updated ||
            !in_range(c.first_record, c.record_count, records.bytes.size() / sizeof(MeshDrawRecord))) {
            return find(Misuse::draw_out_of_range, "records beyond \"" + records.desc.label + '"');
        }
        for (std::uint32_t i = 0; i < c.record_count; ++i) {
            MeshDrawRecord r;
            std::memcpy(&r, records.bytes.data() + (std::size_t{c.first_record} + i) * sizeof r, sizeof r);
            if (!in_range(r.first_index, r.index_count, c.end_index) ||
                !in_range(r.first_item, r.item_count, c.end_item)) {
                return find(Misuse::draw_out_of_range, "record " + std::to_string(i) + " beyond the ends");
            }
            check_mesh_draw({r.first_index, r.index_count, r.base_vertex, r.first_item, r.item_count});
        }
    }
    void operator()(const DrawTriangle&) { check_draw(); }
    void operator()(const DrawLines&) { check_draw(); }
    void operator()(const DrawPoints&) { check_draw(); }
    void operator()(const DrawPulled& c) {
        check_draw();
        if (c.vertex_count % 3 != 0) find(Misuse::draw_out_of_range, "a part of a triangle");
    }

    void operator()(const Dispatch& c) {
        if (in_pass_) find(Misuse::dispatch_inside_pass, "a pass is open");
        if (c.groups_x == 0 || c.groups_y == 0) find(Misuse::dispatch_of_nothing, "no work groups");
        has_pipeline_ = false;
        if (known(objects_.programs, c.program.id, "program") && !computes(c.program))
            find(Misuse::wrong_program, "only a compute program can be dispatched");
    }
    void operator()(const CopyBuffer& c) {
        if (in_pass_) find(Misuse::copy_inside_pass, "a pass is open");
        const bool source_known = known(objects_.buffers, c.source.id, "source");
        if (!known(objects_.buffers, c.destination.id, "destination") || !source_known) return;
        const RecordedBuffer& source = objects_.buffers.at(c.source.id);
        RecordedBuffer& destination = objects_.buffers.at(c.destination.id);
        if (c.source == c.destination || !can_copy(c, source.desc, destination.desc))
            return find(Misuse::copy_mismatch, destination.desc.label);
        std::copy_n(source.bytes.begin() + static_cast<std::ptrdiff_t>(c.source_offset),
                    c.size == 0 ? source.bytes.size() : c.size,
                    destination.bytes.begin() + static_cast<std::ptrdiff_t>(c.destination_offset));
        destination.unread = destination.desc.use == BufferUse::read_back;
        destination.copied_at = submission_;
    }

    void operator()(const CopyTexture& c) {
        if (in_pass_) find(Misuse::copy_inside_pass, "a pass is open");
        const bool source_known = known(objects_.textures, c.source.id, "source");
        if (!known(objects_.textures, c.destination.id, "destination") || !source_known) return;
        const TextureDesc& destination = objects_.textures.at(c.destination.id);
        const TextureDesc& source = objects_.textures.at(c.source.id);
        if (c.source == c.destination || !can_copy(source, destination, c.layer, c.area))
            find(Misuse::copy_mismatch, destination.label);
    }

    void operator()(const GenerateMips& c) {
        if (!known(objects_.textures, c.texture.id, "texture")) return;
        if (in_pass_ && attached(target_, c.texture)) find(Misuse::feedback_loop, "mips of the pass's target");
    }
    void operator()(const Blit& c) {
        if (!known_target(c.source) || !known_target(c.destination)) return;
        check_rect(c.source, c.from);
        check_rect(c.destination, c.to);
        if (!has_colour(c.source) || !has_colour(c.destination)) {
            find(Misuse::incomplete_target, "a blit needs colour on both sides");
        }
        if (c.source == c.destination) find(Misuse::feedback_loop, "blit of a target onto itself");
        if (in_pass_ && (c.source == target_ || c.destination == target_)) {
            find(Misuse::feedback_loop, "blit of the open pass's target");
        }
    }

    void operator()(const BeginTimer& c) {
        if (timer_) find(Misuse::nested_timer, "timer " + std::to_string(*timer_) + " runs");
        timer_ = c.id;
    }
    void operator()(const EndTimer& c) {
        if (timer_ == c.id) {
            timers_.push_back(c.id);
        } else {
            find(Misuse::unbalanced_timer, "timer " + std::to_string(c.id) + " does not run");
        }
        timer_.reset();
    }

private:
    void find(Misuse misuse, const std::string& detail) {
        std::string where;
        if (index_ < list_.commands.size()) {
            where = " (command " + std::to_string(index_) + ": " + to_text(list_.commands[index_]) + ')';
        }
        findings_.push_back({misuse, detail + where});
    }

    template <class Map>
    bool known(const Map& map, std::uint32_t id, const char* what) {
        if (map.count(id) != 0) return true;
        find(Misuse::unknown_handle, std::string{what} + " #" + std::to_string(id));
        return false;
    }
    bool known_target(TargetHandle target) {
        return !target || known(objects_.targets, target.id, "target");  // {0} is the window
    }

    /// Returns the common area of all attachments. A texture destroyed before its target is already reported.
    Size size_of(TargetHandle handle) const {
        const TargetDesc& target = objects_.targets.at(handle.id);
        Size size{std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<std::uint32_t>::max()};
        const auto shrink = [&](const Attachment& attachment) {
            const auto at = objects_.textures.find(attachment.texture.id);
            if (at == objects_.textures.end()) return;
            size = {std::min(size.width, at->second.width), std::min(size.height, at->second.height)};
        };
        for (const Attachment& colour : target.colours) shrink(colour);
        shrink(target.depth);
        return size;
    }
    void check_rect(TargetHandle target, const Rect& rect) {
        if (target && objects_.targets.count(target.id) == 0) return;  // unknown target is already reported
        constexpr std::uint32_t any = std::numeric_limits<std::int32_t>::max();
        const Size size = target ? size_of(target) : Size{any, any};  // the window's size is unknown here
        if (!in_target(rect, size.width, size.height)) find(Misuse::viewport_out_of_target, "rectangle");
    }
    bool computes(ProgramHandle program) const { return !objects_.programs.at(program.id).compute.empty(); }
    bool has_colour(TargetHandle target) const { return !target || !objects_.targets.at(target.id).colours.empty(); }

    bool attached(TargetHandle handle, TextureHandle texture) const {
        const auto at = objects_.targets.find(handle.id);
        if (at == objects_.targets.end()) return false;
        const auto names = [texture](const Attachment& a) { return a.texture == texture; };
        return names(at->second.depth) || std::any_of(at->second.colours.begin(), at->second.colours.end(), names);
    }
    /// Returns true if the current pass writes the texture. Its depth may be tested and read in the same pass.
    bool written(TargetHandle handle, TextureHandle texture) const {
        const auto at = objects_.targets.find(handle.id);
        if (at == objects_.targets.end() || writes_depth_ || at->second.depth.texture != texture)
            return attached(handle, texture);
        return false;
    }
    void check_draw() {
        if (!in_pass_) return find(Misuse::draw_outside_pass, "BeginPass comes first");
        if (!has_pipeline_) find(Misuse::draw_without_pipeline, "SetPipeline comes first");
        for (const auto& [unit, texture] : textures_) {
            if (written(target_, texture)) find(Misuse::feedback_loop, "unit " + std::to_string(unit));
        }
    }
    void check_mesh_draw(const DrawMeshes& c) {
        if (!has_meshes_) return find(Misuse::draw_without_meshes, "BindMeshes comes first");
        const RecordedBuffer& indices = objects_.buffers.at(meshes_.indices.id);
        if (!in_range(c.first_index, c.index_count, indices.bytes.size() / meshes_.layout.index_bytes())) {
            find(Misuse::draw_out_of_range, "indices beyond \"" + indices.desc.label + '"');
        } else {
            check_vertices(c, indices);
        }
        const RecordedBuffer& items = objects_.buffers.at(meshes_.draw_items.id);
        if (!in_range(c.first_item, c.item_count, items.bytes.size() / kItemBytes)) {
            find(Misuse::draw_out_of_range, "items beyond \"" + items.desc.label + '"');
        }
    }
    void check_vertices(const DrawMeshes& c, const RecordedBuffer& indices) {
        const RecordedBuffer& vertices = objects_.buffers.at(meshes_.vertices.id);
        const MeshLayout& layout = meshes_.layout;
        const std::uint64_t stride = layout.stride == 0 ? kVertexBytes : layout.stride;
        const std::uint64_t vertex_bytes = layout.stride == 0 ? kVertexBytes : position_bytes(layout.position);
        const std::uint64_t before = layout.position_offset + vertex_bytes;
        const auto count = static_cast<std::int64_t>(
            before > vertices.bytes.size() ? 0 : (vertices.bytes.size() - before) / stride + 1);
        const std::uint64_t index_bytes = layout.index_bytes();
        for (std::uint32_t i = 0; i < c.index_count; ++i) {
            std::uint32_t index = 0;
            std::memcpy(&index, indices.bytes.data() + (std::uint64_t{c.first_index} + i) * index_bytes, index_bytes);
            const std::int64_t vertex = std::int64_t{index} + c.base_vertex;
            if (vertex < 0 || vertex >= count) {
                return find(Misuse::draw_out_of_range, "vertex beyond \"" + vertices.desc.label + '"');
            }
        }
    }

    const CommandList& list_;
    std::uint64_t submission_;
    const DeviceInfo& info_;
    RecordedObjects& objects_;
    std::vector<Finding>& findings_;
    std::size_t index_ = 0;

    std::size_t open_groups_ = 0;
    bool in_pass_ = false, has_pipeline_ = false, has_meshes_ = false, writes_depth_ = false;
    TargetHandle target_{};
    std::map<std::uint32_t, TextureHandle> textures_;  // by unit
    BindMeshes meshes_{};
    std::optional<std::uint32_t> timer_;
    std::vector<std::uint32_t> timers_;
};

}  // namespace

std::vector<std::uint32_t> check_list(const CommandList& list, std::uint64_t submission, const DeviceInfo& info,
                                      RecordedObjects& objects, std::vector<Finding>& findings) {
    return ListChecker(list, submission, info, objects, findings).run();
}

}  // namespace gnomon::gl
