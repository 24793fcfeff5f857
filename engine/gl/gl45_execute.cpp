#include "engine/gl/gl45_execute.h"

#include <algorithm>
#include <array>
#include <optional>

#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {

constexpr GLsizei kItemBytes = 2 * sizeof(std::uint32_t);

/// Executes a list, one operator() per command.
class ListExecutor {
public:
    ListExecutor(const CommandList& list, std::uint64_t submission, const GlObjects& objects, GlState& state,
                 const ListServices& services)
        : list_(list),
          submission_(submission),
          objects_(objects),
          fixtures_(state.fixtures()),
          state_(state),
          timers_(services.timers),
          readbacks_(services.readbacks),
          uploads_(services.uploads) {}

    Failure run() {
        state_.begin_list();
        uploads_in_order_ = !list_.bytes.empty() && uploads_.begin(list_.bytes);
        for (const Command& command : list_.commands) std::visit(*this, command);
        if (!timers_.abandon() || open_groups_ != 0 || in_pass_) note(Failure::invalid_value);
        for (; open_groups_ > 0; --open_groups_) pop_group();
        if (uploads_in_order_) uploads_.end();
        const Failure error = state_.end_list();
        return error == Failure::none ? failure_ : error;
    }

    void operator()(const BeginGroup& c) {
        if (open_groups_++ >= state_.group_limit()) return;
        const std::string_view text = c.label.text();
        const auto length = static_cast<GLsizei>(std::min(text.size(), fixtures_.message_bytes));
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, length, text.data());
    }
    void operator()(const EndGroup&) {
        if (open_groups_ == 0) return note(Failure::invalid_value);
        pop_group();
        --open_groups_;
    }

    void operator()(const BeginPass& c) {
        if (in_pass_) return note(Failure::invalid_value);
        in_pass_ = true;
        drawable_ = false;
        const GlTarget* target = nullptr;
        if (!usable(c.target, target)) return;
        if (c.viewport.width <= 0 || c.viewport.height <= 0) return note(Failure::invalid_value);
        drawable_ = true;
        const GlTarget into = target == nullptr ? GlTarget{0, 0, 0, 1} : *target;
        state_.begin_pass(into.name, into.colours, c.viewport);
        clear(c, into);
    }
    void operator()(const EndPass& c) {
        if (!in_pass_) note(Failure::invalid_value);
        in_pass_ = drawable_ = false;
        if (c.wrote_storage) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }

    void operator()(const SetScissor& c) {
        if (c.rect.width < 0 || c.rect.height < 0) return note(Failure::invalid_value);
        state_.set_scissor(c.rect);
    }
    void operator()(const SetPipeline& c) {
        if (pipeline_ == c.state) return;
        pipeline_.reset();
        const GlProgram* program = find_object(objects_.programs, c.state.program.id);
        if (program == nullptr) return note(Failure::invalid_value);
        pipeline_ = c.state;
        state_.use_pipeline(c.state, *program);
    }

    void operator()(const BindTexture& c) {
        if (c.unit >= static_cast<std::uint32_t>(fixtures_.texture_units)) return note(Failure::invalid_value);
        const GlTexture* texture = find_object(objects_.textures, c.texture.id);
        const GLuint* sampler = find_object(objects_.samplers, c.sampler.id);
        if ((c.texture && texture == nullptr) || (c.sampler && sampler == nullptr)) note(Failure::invalid_value);
        // Parameters of someone else's texture may forbid plain reads: compare mode, mipmaps that do not exist.
        const GLuint plain = texture != nullptr && texture->imported ? objects_.plain_sampler : 0;
        state_.bind_texture(c.unit, texture == nullptr ? GL_NONE : texture->target,
                            texture == nullptr ? 0 : texture->name, sampler == nullptr ? plain : *sampler);
    }
    void operator()(const BindUniforms& c) {
        const GlBuffer* buffer = find_object(objects_.buffers, c.buffer.id);
        if (buffer == nullptr || c.binding >= static_cast<std::uint32_t>(fixtures_.uniform_bindings) || c.size == 0 ||
            !in_range(c.offset, c.size, buffer->desc.size) || c.offset % fixtures_.uniform_alignment != 0) {
            return note(Failure::invalid_value);
        }
        state_.bind_uniforms(c.binding, buffer->name, c.offset, c.size);
    }
    void operator()(const BindStorage& c) {
        const GlBuffer* buffer = find_object(objects_.buffers, c.buffer.id);
        if (buffer == nullptr || c.binding >= static_cast<std::uint32_t>(fixtures_.storage_bindings)) {
            return note(Failure::invalid_value);
        }
        state_.bind_storage(c.binding, buffer->name);
    }
    void operator()(const BindTexels& c) {
        const GlBuffer* buffer = find_object(objects_.buffers, c.buffer.id);
        if (buffer == nullptr || buffer->texels == 0 || c.unit >= static_cast<std::uint32_t>(fixtures_.texture_units))
            return note(Failure::invalid_value);
        state_.bind_texture(c.unit, GL_TEXTURE_BUFFER, buffer->texels, 0);
    }
    void operator()(const UpdateBuffer& c) {
        const GlBuffer* buffer = find_object(objects_.buffers, c.buffer.id);
        if (in_pass_ || buffer == nullptr || buffer->desc.use != BufferUse::updated ||
            !in_range(c.offset, c.size, buffer->desc.size) || !in_range(c.first, c.size, list_.bytes.size())) {
            return note(Failure::invalid_value);
        }
        if (uploads_in_order_) return uploads_.copy(c.first, c.size, buffer->name, c.offset);
        glNamedBufferSubData(buffer->name, static_cast<GLintptr>(c.offset), static_cast<GLsizeiptr>(c.size),
                             list_.bytes.data() + c.first);
    }

    void operator()(const ClearBuffer& c) {
        const GlBuffer* buffer = find_object(objects_.buffers, c.buffer.id);
        if (in_pass_ || buffer == nullptr || buffer->desc.use != BufferUse::updated || c.offset % 4 != 0 ||
            c.size % 4 != 0 || !in_range(c.offset, c.size, buffer->desc.size)) {
            return note(Failure::invalid_value);
        }
        glClearNamedBufferSubData(buffer->name, GL_R32UI, static_cast<GLintptr>(c.offset),
                                  static_cast<GLsizeiptr>(c.size), GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    }

    void operator()(const BindMeshes& c) {
        const GlBuffer* vertices = find_object(objects_.buffers, c.vertices.id);
        indices_ = find_object(objects_.buffers, c.indices.id);
        items_ = find_object(objects_.buffers, c.draw_items.id);
        if (vertices == nullptr || indices_ == nullptr || items_ == nullptr) {
            indices_ = items_ = nullptr;
            return note(Failure::invalid_value);
        }
        layout_ = c.layout;
        state_.bind_meshes(vertices->name, items_->name, indices_->name, c.layout);
    }
    void operator()(const DrawMeshes& c) {
        if (!can_draw(layout_.stride == 0 ? fixtures_.mesh_layout : fixtures_.other_layout)) return;
        if (indices_ == nullptr ||
            !in_range(c.first_index, c.index_count, indices_->desc.size / layout_.index_bytes()) ||
            !in_range(c.first_item, c.item_count, items_->desc.size / kItemBytes)) {
            return note(Failure::invalid_value);
        }
        // OpenGL takes the offset into the index buffer as a pointer.
        const auto bytes = static_cast<std::uintptr_t>(c.first_index) * layout_.index_bytes();
        const auto* offset = reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(c.index_count),
                                                      layout_.short_indices ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                                      offset, static_cast<GLsizei>(c.item_count), c.base_vertex,
                                                      c.first_item);
    }
    void operator()(const DrawMeshesIndirect& c) {
        if (!can_draw(layout_.stride == 0 ? fixtures_.mesh_layout : fixtures_.other_layout)) return;
        const GlBuffer* records = find_object(objects_.buffers, c.records.id);
        if (indices_ == nullptr || records == nullptr || records->desc.use != BufferUse::updated ||
            c.end_index > indices_->desc.size / layout_.index_bytes() || c.end_item > items_->desc.size / kItemBytes ||
            !in_range(c.first_record, c.record_count, records->desc.size / sizeof(MeshDrawRecord))) {
            return note(Failure::invalid_value);
        }
        state_.bind_draw_records(records->name);
        // OpenGL takes the offset into the buffer as a pointer.
        const auto bytes = static_cast<std::uintptr_t>(c.first_record) * sizeof(MeshDrawRecord);
        const auto* offset = reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
        glMultiDrawElementsIndirect(GL_TRIANGLES, layout_.short_indices ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT, offset,
                                    static_cast<GLsizei>(c.record_count), sizeof(MeshDrawRecord));
    }
    void operator()(const DrawTriangle& c) {
        constexpr GLsizei corners = 3;
        if (!can_draw(fixtures_.empty_layout)) return;
        if (c.depth) state_.set_depth_range(*c.depth, *c.depth);
        glDrawArrays(GL_TRIANGLES, 0, corners);
        if (c.depth) state_.set_depth_range(0.0f, 1.0f);
    }
    void operator()(const DrawLines& c) {
        if (can_draw(fixtures_.empty_layout, true)) glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(c.vertex_count));
    }

    void operator()(const DrawPoints& c) {
        if (can_draw(fixtures_.empty_layout))
            glDrawArrays(GL_POINTS, static_cast<GLint>(c.first_vertex), static_cast<GLsizei>(c.vertex_count));
    }

    void operator()(const DrawPulled& c) {
        if (c.vertex_count % 3 != 0) return note(Failure::invalid_value);
        if (!can_draw(fixtures_.empty_layout)) return;
        glDrawArrays(GL_TRIANGLES, static_cast<GLint>(c.first_vertex), static_cast<GLsizei>(c.vertex_count));
    }

    void operator()(const Dispatch& c) {
        const GlProgram* program = find_object(objects_.programs, c.program.id);
        if (in_pass_ || program == nullptr || c.groups_x == 0 || c.groups_y == 0) return note(Failure::invalid_value);
        pipeline_.reset();
        state_.use_compute(*program);
        state_.prepare_dispatch();
        glDispatchCompute(c.groups_x, c.groups_y, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
    void operator()(const CopyBuffer& c) {
        const GlBuffer* source = find_object(objects_.buffers, c.source.id);
        const GlBuffer* destination = find_object(objects_.buffers, c.destination.id);
        if (in_pass_ || source == nullptr || destination == nullptr || source == destination ||
            !can_copy(c, source->desc, destination->desc)) {
            return note(Failure::invalid_value);
        }
        glCopyNamedBufferSubData(source->name, destination->name, static_cast<GLintptr>(c.source_offset),
                                 static_cast<GLintptr>(c.destination_offset),
                                 static_cast<GLsizeiptr>(c.size == 0 ? source->desc.size : c.size));
        if (destination->desc.use == BufferUse::read_back) readbacks_.expect(c.destination.id);
    }

    void operator()(const CopyTexture& c) {
        const GlTexture* source = find_object(objects_.textures, c.source.id);
        const GlTexture* destination = find_object(objects_.textures, c.destination.id);
        if (in_pass_ || source == nullptr || destination == nullptr || source == destination ||
            !can_copy(source->desc, destination->desc, c.layer, c.area)) {
            return note(Failure::invalid_value);
        }
        const auto layer = static_cast<GLint>(c.layer);
        const Rect all{0, 0, static_cast<std::int32_t>(source->desc.width),
                       static_cast<std::int32_t>(source->desc.height)};
        const Rect& of = c.area.width == 0 ? all : c.area;
        glCopyImageSubData(source->name, source->target, 0, of.x, of.y, layer, destination->name, destination->target,
                           0, of.x, of.y, layer, of.width, of.height, 1);
    }

    void operator()(const GenerateMips& c) {
        const GlTexture* texture = find_object(objects_.textures, c.texture.id);
        if (texture == nullptr) return note(Failure::invalid_value);
        glGenerateTextureMipmap(texture->name);
    }
    void operator()(const Blit& c) {
        const GlTarget *source = nullptr, *destination = nullptr;
        if (!usable(c.source, source) || !usable(c.destination, destination)) return;
        state_.begin_blit();
        glBlitNamedFramebuffer(source == nullptr ? 0 : source->name, destination == nullptr ? 0 : destination->name,
                               c.from.x, c.from.y, c.from.x + c.from.width, c.from.y + c.from.height, c.to.x, c.to.y,
                               c.to.x + c.to.width, c.to.y + c.to.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        state_.end_blit();
    }

    void operator()(const BeginTimer& c) {
        if (!timers_.begin(c.id, submission_)) note(Failure::invalid_value);
    }
    void operator()(const EndTimer& c) {
        if (!timers_.end(c.id)) note(Failure::invalid_value);
    }

private:
    void note(Failure failure) {
        if (failure_ == Failure::none) failure_ = failure;
    }
    void pop_group() {
        if (open_groups_ <= state_.group_limit()) glPopDebugGroup();
    }

    /// Finds the target. Returns false and notes the failure if it is unknown, or is the window in a context without
    /// one. The window gives a null `target`.
    bool usable(TargetHandle handle, const GlTarget*& target) {
        if (handle) {
            target = find_object(objects_.targets, handle.id);
            if (target == nullptr) note(Failure::invalid_value);
            return target != nullptr;
        }
        if (glCheckNamedFramebufferStatus(0, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return true;
        note(Failure::incomplete_target);
        return false;
    }
    void clear(const BeginPass& c, const GlTarget& target) {
        if (c.clear_depth) {
            state_.set_depth_mask(true);  // clears obey the previous pipeline's mask
            glClearBufferfv(GL_DEPTH, 0, &c.depth);
            if (pipeline_) state_.set_depth_mask(pipeline_->depth_write);
        }
        if (!c.clear_colour) return;
        std::array<GLuint, 4> whole{};
        std::transform(c.colour.begin(), c.colour.end(), whole.begin(), [](float value) {
            constexpr float kBeyond = 4294967296.0f;  // 2^32
            return value >= kBeyond ? ~GLuint{0} : static_cast<GLuint>(std::max(value, 0.0f));
        });
        for (std::size_t i = 0; i < target.colours; ++i) {
            if ((target.integer_colours >> i & 1u) != 0)
                glClearBufferuiv(GL_COLOR, static_cast<GLint>(i), whole.data());
            else
                glClearBufferfv(GL_COLOR, static_cast<GLint>(i), c.colour.data());
        }
    }
    bool can_draw(GLuint layout, bool lines = false) {
        if (!in_pass_ || !pipeline_) note(Failure::invalid_value);
        if (!drawable_ || !pipeline_) return false;  // the reason has been noted before
        state_.prepare_draw(layout, lines);
        return true;
    }

    const CommandList& list_;
    std::uint64_t submission_;
    const GlObjects& objects_;
    const GlFixtures& fixtures_;
    GlState& state_;
    GlTimers& timers_;
    GlReadbacks& readbacks_;
    GlUploads& uploads_;

    Failure failure_ = Failure::none;
    std::size_t open_groups_ = 0;
    bool uploads_in_order_ = false;  // by the device; false: by the processor
    bool in_pass_ = false, drawable_ = false;
    std::optional<PipelineState> pipeline_;
    const GlBuffer* indices_ = nullptr;
    const GlBuffer* items_ = nullptr;
    MeshLayout layout_;
};

}  // namespace

Failure execute(const CommandList& list, std::uint64_t submission, const GlObjects& objects, GlState& state,
                const ListServices& services) {
    return ListExecutor(list, submission, objects, state, services).run();
}

}  // namespace gnomon::gl
