#include "engine/gl/commands.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace gnomon::gl {

namespace {

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", static_cast<double>(value));
    return text;
}

template <class T>
std::string number(T value) {
    return std::to_string(value);
}

template <class Tag>
std::string number(Handle<Tag> handle) {
    return '#' + std::to_string(handle.id);
}

std::string number(const Rect& r) {
    return number(r.x) + ',' + number(r.y) + ' ' + number(r.width) + 'x' + number(r.height);
}

template <class T>
std::string field(const char* name, const T& value) {
    return std::string{" "} + name + '=' + number(value);
}

const char* name(CullMode mode) {
    switch (mode) {
        case CullMode::none:
            return "none";
        case CullMode::back:
            return "back";
        case CullMode::front:
            return "front";
    }
    return "?";
}

const char* name(DepthTest test) {
    switch (test) {
        case DepthTest::off:
            return "off";
        case DepthTest::greater_equal:
            return "greater_equal";
        case DepthTest::greater:
            return "greater";
        case DepthTest::equal:
            return "equal";
        case DepthTest::less:
            return "less";
    }
    return "?";
}

const char* name(Blend blend) {
    switch (blend) {
        case Blend::off:
            return "off";
        case Blend::add:
            return "add";
        case Blend::alpha:
            return "alpha";
        case Blend::largest:
            return "largest";
    }
    return "?";
}

struct Writer {
    std::string operator()(const BeginGroup& c) const { return "BeginGroup \"" + std::string(c.label.text()) + '"'; }
    std::string operator()(const EndGroup&) const { return "EndGroup"; }
    std::string operator()(const BeginPass& c) const {
        std::string text = "BeginPass" + field("target", c.target) + field("viewport", c.viewport);
        if (c.clear_depth) text += field("depth", c.depth);
        if (c.clear_colour) {
            text += " colour=" + number(c.colour[0]) + ',' + number(c.colour[1]) + ',' + number(c.colour[2]) + ',' +
                    number(c.colour[3]);
        }
        return text;
    }
    std::string operator()(const EndPass& c) const { return c.wrote_storage ? "EndPass storage" : "EndPass"; }
    std::string operator()(const SetScissor& c) const {
        return c.rect.width == 0 ? std::string{"SetScissor off"} : "SetScissor" + field("rect", c.rect);
    }
    std::string operator()(const SetPipeline& c) const {
        const PipelineState& s = c.state;
        std::string text = "SetPipeline" + field("program", s.program) + " cull=" + name(s.cull) +
                           " depth_test=" + name(s.depth_test) + " blend=" + name(s.blend);
        if (s.front_is_clockwise) text += " front_is_clockwise";
        if (s.depth_write) text += " depth_write";
        if (s.depth_clamp) text += " depth_clamp";
        return text;
    }
    std::string operator()(const BindTexture& c) const {
        return "BindTexture" + field("unit", c.unit) + field("texture", c.texture) + field("sampler", c.sampler);
    }
    std::string operator()(const BindUniforms& c) const {
        return "BindUniforms" + field("binding", c.binding) + field("buffer", c.buffer) + field("offset", c.offset) +
               field("size", c.size);
    }
    std::string operator()(const BindStorage& c) const {
        return "BindStorage" + field("binding", c.binding) + field("buffer", c.buffer);
    }
    std::string operator()(const BindTexels& c) const {
        return "BindTexels" + field("unit", c.unit) + field("buffer", c.buffer);
    }
    std::string operator()(const UpdateBuffer& c) const {
        return "UpdateBuffer" + field("buffer", c.buffer) + field("offset", c.offset) + field("first", c.first) +
               field("size", c.size);
    }
    std::string operator()(const ClearBuffer& c) const {
        return "ClearBuffer" + field("buffer", c.buffer) + field("offset", c.offset) + field("size", c.size);
    }
    std::string operator()(const BindMeshes& c) const {
        return "BindMeshes" + field("vertices", c.vertices) + field("indices", c.indices) +
               field("draw_items", c.draw_items) +
               (c.layout == MeshLayout{}
                    ? std::string()
                    : field("stride", c.layout.stride) + field("offset", c.layout.position_offset) +
                          field("format", static_cast<unsigned>(c.layout.position)) +
                          field("index_bytes", c.layout.index_bytes()));
    }
    std::string operator()(const DrawMeshes& c) const {
        return "DrawMeshes" + field("first_index", c.first_index) + field("index_count", c.index_count) +
               field("base_vertex", c.base_vertex) + field("first_item", c.first_item) +
               field("item_count", c.item_count);
    }
    std::string operator()(const DrawMeshesIndirect& c) const {
        return "DrawMeshesIndirect" + field("records", c.records) + field("first_record", c.first_record) +
               field("record_count", c.record_count) + field("end_index", c.end_index) + field("end_item", c.end_item);
    }
    std::string operator()(const DrawTriangle& c) const {
        return c.depth ? "DrawTriangle" + field("depth", *c.depth) : "DrawTriangle";
    }
    std::string operator()(const DrawLines& c) const { return "DrawLines" + field("vertex_count", c.vertex_count); }
    std::string operator()(const DrawPoints& c) const {
        return "DrawPoints" + field("first_vertex", c.first_vertex) + field("vertex_count", c.vertex_count);
    }
    std::string operator()(const DrawPulled& c) const {
        return "DrawPulled" + field("first_vertex", c.first_vertex) + field("vertex_count", c.vertex_count);
    }
    std::string operator()(const Dispatch& c) const {
        return "Dispatch" + field("program", c.program) + field("groups_x", c.groups_x) + field("groups_y", c.groups_y);
    }
    std::string operator()(const CopyBuffer& c) const {
        std::string text = "CopyBuffer" + field("source", c.source) + field("destination", c.destination);
        if (c.source_offset != 0) text += field("source_offset", c.source_offset);
        if (c.destination_offset != 0) text += field("destination_offset", c.destination_offset);
        return c.size == 0 ? text : text + field("size", c.size);
    }
    std::string operator()(const CopyTexture& c) const {
        return "CopyTexture" + field("source", c.source) + field("destination", c.destination) +
               field("layer", c.layer) + (c.area.width == 0 ? "" : field("area", c.area));
    }
    std::string operator()(const GenerateMips& c) const { return "GenerateMips" + field("texture", c.texture); }
    std::string operator()(const Blit& c) const {
        return "Blit" + field("source", c.source) + field("destination", c.destination) + field("from", c.from) +
               field("to", c.to);
    }
    std::string operator()(const BeginTimer& c) const { return "BeginTimer" + field("id", c.id); }
    std::string operator()(const EndTimer& c) const { return "EndTimer" + field("id", c.id); }
};

}  // namespace

GroupLabel::GroupLabel(std::string_view kind, std::string_view name, std::string_view part) {
    append(kind, kMost);
    append(" ", kMost);
    append(name, kMost - std::min(kMost, part.size() + 1));
    append(" ", kMost);
    append(part, kMost);
}

void GroupLabel::append(std::string_view text, std::size_t end) {
    const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u; };
    std::size_t count = std::min(text.size(), end - std::min<std::size_t>(end, size_));
    while (count > 0 && count < text.size() && continues(count)) --count;
    std::copy_n(text.begin(), count, bytes_.begin() + size_);
    size_ = static_cast<std::uint8_t>(size_ + count);
}

void append_mesh_draws(const CommandList& list, const Command& command, std::vector<DrawMeshes>& draws) {
    if (const auto* draw = std::get_if<DrawMeshes>(&command)) draws.push_back(*draw);
    const auto* many = std::get_if<DrawMeshesIndirect>(&command);
    if (many == nullptr) return;
    const std::uint64_t first = std::uint64_t{many->first_record} * sizeof(MeshDrawRecord);
    const std::uint64_t size = std::uint64_t{many->record_count} * sizeof(MeshDrawRecord);
    const UpdateBuffer* upload = nullptr;
    for (const Command& earlier : list.commands) {
        if (&earlier == &command) break;
        const auto* update = std::get_if<UpdateBuffer>(&earlier);
        const bool holds = update != nullptr && update->buffer == many->records && update->offset <= first &&
                           first - update->offset <= update->size && size <= update->size - (first - update->offset);
        if (holds) upload = update;
    }
    if (upload == nullptr) return;
    const std::byte* from = list.bytes.data() + upload->first + (first - upload->offset);
    for (std::uint32_t i = 0; i < many->record_count; ++i) {
        MeshDrawRecord record;
        std::memcpy(&record, from + i * sizeof record, sizeof record);
        draws.push_back(
            {record.first_index, record.index_count, record.base_vertex, record.first_item, record.item_count});
    }
}

std::string to_text(const Command& command) { return std::visit(Writer{}, command); }

std::string to_text(const CommandList& list) {
    std::string text;
    for (const Command& command : list.commands) text += to_text(command) + '\n';
    return text;
}

}  // namespace gnomon::gl
