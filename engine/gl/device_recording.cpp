#include "engine/gl/device_recording.h"

#include <algorithm>
#include <utility>

#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {

using Kind = ResourceCall::Kind;

constexpr std::uint32_t kRecordingMaxPx = 16384;  // as llvmpipe
constexpr std::uint32_t kRecordingMaxLayers = 2048;
constexpr std::uint32_t kRecordingMaxPoint_px = 64;
constexpr std::uint32_t kRecordingAlignment = 256;

template <class Map>
auto find_value(Map& map, std::uint32_t id) -> decltype(&map.begin()->second) {
    const auto at = map.find(id);
    return at == map.end() ? nullptr : &at->second;
}

std::string quoted(const std::string& label, const char* why) { return '"' + label + "\": " + why; }

const std::string& label_of(const RecordedBuffer& buffer) { return buffer.desc.label; }
template <class Desc>
const std::string& label_of(const Desc& desc) {
    return desc.label;
}

std::uint64_t bytes_of(const TextureDesc& desc) { return byte_size(desc); }
std::uint64_t bytes_of(const RecordedBuffer& buffer) { return buffer.desc.size; }
template <class Desc>
std::uint64_t bytes_of(const Desc&) {
    return 0;
}

/// Calls visit(map) for each kind of object.
template <class Visit>
void for_each_kind(const RecordedObjects& objects, Visit visit) {
    visit(objects.textures);
    visit(objects.samplers);
    visit(objects.buffers);
    visit(objects.programs);
    visit(objects.targets);
}

}  // namespace

const char* to_text(Misuse misuse) {
    switch (misuse) {
        case Misuse::unknown_handle:
            return "unknown_handle";
        case Misuse::draw_outside_pass:
            return "draw_outside_pass";
        case Misuse::nested_pass:
            return "nested_pass";
        case Misuse::unbalanced_pass:
            return "unbalanced_pass";
        case Misuse::unbalanced_group:
            return "unbalanced_group";
        case Misuse::unbalanced_timer:
            return "unbalanced_timer";
        case Misuse::nested_timer:
            return "nested_timer";
        case Misuse::draw_without_pipeline:
            return "draw_without_pipeline";
        case Misuse::draw_without_meshes:
            return "draw_without_meshes";
        case Misuse::draw_out_of_range:
            return "draw_out_of_range";
        case Misuse::wrong_program:
            return "wrong_program";
        case Misuse::dispatch_inside_pass:
            return "dispatch_inside_pass";
        case Misuse::dispatch_of_nothing:
            return "dispatch_of_nothing";
        case Misuse::copy_inside_pass:
            return "copy_inside_pass";
        case Misuse::copy_mismatch:
            return "copy_mismatch";
        case Misuse::read_of_other_buffer:
            return "read_of_other_buffer";
        case Misuse::update_inside_pass:
            return "update_inside_pass";
        case Misuse::update_out_of_range:
            return "update_out_of_range";
        case Misuse::update_of_fixed_buffer:
            return "update_of_fixed_buffer";
        case Misuse::buffer_without_texels:
            return "buffer_without_texels";
        case Misuse::uniform_misaligned:
            return "uniform_misaligned";
        case Misuse::uniform_out_of_range:
            return "uniform_out_of_range";
        case Misuse::viewport_out_of_target:
            return "viewport_out_of_target";
        case Misuse::incomplete_target:
            return "incomplete_target";
        case Misuse::feedback_loop:
            return "feedback_loop";
        case Misuse::destroyed_while_attached:
            return "destroyed_while_attached";
        case Misuse::bad_description:
            return "bad_description";
        case Misuse::leak:
            return "leak";
    }
    return "?";
}

RecordingDevice::RecordingDevice(DeviceInfo info) : info_(std::move(info)) {}

DeviceInfo RecordingDevice::default_info() {
    DeviceInfo info;
    info.name = "recording";
    info.is_software = true;
    info.max_texture_px = kRecordingMaxPx;
    info.max_cube_px = kRecordingMaxPx;
    info.max_layers = kRecordingMaxLayers;
    info.max_point_px = kRecordingMaxPoint_px;
    info.uniform_alignment = kRecordingAlignment;
    return info;
}

void RecordingDevice::fail_call(std::uint64_t index, Failure failure) { failing_calls_[index] = failure; }
void RecordingDevice::fail_from(std::uint64_t index, Failure failure, bool submissions) {
    lasting_fault_ = {index, failure, submissions};
}
void RecordingDevice::fail_label(std::string text, Failure failure) {
    failing_labels_.emplace_back(std::move(text), failure);
}
void RecordingDevice::stop_failing() {
    failing_calls_.clear();
    lasting_fault_.reset();
    failing_labels_.clear();
}
std::uint64_t RecordingDevice::calls() const { return calls_; }

void RecordingDevice::script_readback(std::string text, std::vector<std::byte> contents) {
    scripts_.emplace_back(std::move(text), std::move(contents));
}
void RecordingDevice::delay_readbacks(std::uint64_t submissions) { readback_delay_ = submissions; }

const std::vector<ResourceCall>& RecordingDevice::resource_calls() const { return log_; }
const std::vector<CommandList>& RecordingDevice::submissions() const { return lists_; }
const std::vector<Finding>& RecordingDevice::findings() const { return findings_; }
void RecordingDevice::forget() {
    log_.clear();
    lists_.clear();
    findings_.clear();
}

std::size_t RecordingDevice::live_count() const {
    std::size_t count = 0;
    for_each_kind(objects_, [&](const auto& map) { count += map.size(); });
    return count;
}

std::uint64_t RecordingDevice::live_bytes() const {
    std::uint64_t bytes = 0;
    for_each_kind(objects_, [&](const auto& map) {
        for (const auto& [id, object] : map) bytes += bytes_of(object);
    });
    return bytes;
}

std::vector<std::string> RecordingDevice::live_labels() const {
    std::vector<std::string> labels;
    for_each_kind(objects_, [&](const auto& map) {
        for (const auto& [id, object] : map) labels.push_back(label_of(object));
    });
    std::sort(labels.begin(), labels.end());
    return labels;
}

const TextureDesc* RecordingDevice::texture(TextureHandle h) const { return find_value(objects_.textures, h.id); }
const TargetDesc* RecordingDevice::target(TargetHandle h) const { return find_value(objects_.targets, h.id); }
const ProgramDesc* RecordingDevice::program(ProgramHandle h) const { return find_value(objects_.programs, h.id); }
const BufferDesc* RecordingDevice::buffer(BufferHandle h) const {
    const RecordedBuffer* buffer = find_value(objects_.buffers, h.id);
    return buffer == nullptr ? nullptr : &buffer->desc;
}
std::span<const std::byte> RecordingDevice::buffer_bytes(BufferHandle h) const {
    const RecordedBuffer* buffer = find_value(objects_.buffers, h.id);
    return buffer == nullptr ? std::span<const std::byte>{} : std::span<const std::byte>{buffer->bytes};
}

void RecordingDevice::check_leaks() {
    for (const std::string& label : live_labels()) find(Misuse::leak, quoted(label, "is still alive"));
}

const DeviceInfo& RecordingDevice::info() const { return info_; }
std::uint64_t RecordingDevice::compiled_programs() const { return compiled_; }

std::optional<Failure> RecordingDevice::injected(Call call, const std::string* label) {
    const std::optional<Failure> failure = lost_ ? Failure::context_lost : scheduled(calls_, call, label);
    ++calls_;
    if (failure == Failure::context_lost) lost_ = true;
    return failure;
}

std::optional<Failure> RecordingDevice::scheduled(std::uint64_t index, Call call, const std::string* label) const {
    if (const auto at = failing_calls_.find(index); at != failing_calls_.end()) return at->second;
    if (lasting_fault_ && index >= lasting_fault_->first && (call == Call::creation || lasting_fault_->submissions)) {
        return lasting_fault_->failure;
    }
    if (label == nullptr) return std::nullopt;
    for (const auto& [text, failure] : failing_labels_) {
        if (label->find(text) != std::string::npos) return failure;
    }
    return std::nullopt;
}

void RecordingDevice::find(Misuse misuse, std::string detail) { findings_.push_back({misuse, std::move(detail)}); }

void RecordingDevice::log(Kind kind, std::uint32_t id, std::string label, std::uint64_t bytes, bool failed) {
    log_.push_back({kind, id, std::move(label), bytes, failed});
}

template <class H, class Map, class Value>
Created<H> RecordingDevice::admit(Kind kind, Map& map, std::string label, Value value, std::uint64_t bytes) {
    const std::uint32_t id = next_id_++;
    map.emplace(id, std::move(value));
    log(kind, id, std::move(label), bytes, false);
    return {H{id}};
}

template <class H>
Created<H> RecordingDevice::refuse(Kind kind, const std::string& label, std::uint64_t bytes, Failure failure) {
    log(kind, 0, label, bytes, true);
    return {H{}, failure, quoted(label, to_text(failure))};
}

Created<TextureHandle> RecordingDevice::create_texture(const TextureDesc& desc, std::span<const std::byte> pixels) {
    const auto kind = Kind::create_texture;
    const std::optional<Failure> failure = injected(Call::creation, &desc.label);
    const Failure checked = check_texture(desc, info_, pixels.size());
    if (checked != Failure::none) {
        find(Misuse::bad_description, quoted(desc.label, "size, layers, mips or pixels"));
        return refuse<TextureHandle>(kind, desc.label, 0, failure.value_or(checked));
    }
    if (failure) return refuse<TextureHandle>(kind, desc.label, byte_size(desc), *failure);
    return admit<TextureHandle>(kind, objects_.textures, desc.label, desc, byte_size(desc));
}

Created<SamplerHandle> RecordingDevice::create_sampler(const SamplerDesc& desc) {
    if (const auto failure = injected(Call::creation, nullptr)) {
        return refuse<SamplerHandle>(Kind::create_sampler, desc.label, 0, *failure);
    }
    return admit<SamplerHandle>(Kind::create_sampler, objects_.samplers, desc.label, desc, 0);
}

Created<BufferHandle> RecordingDevice::create_buffer(const BufferDesc& desc, std::span<const std::byte> bytes) {
    const auto kind = Kind::create_buffer;
    const std::optional<Failure> failure = injected(Call::creation, &desc.label);
    const Failure checked = check_buffer(desc, bytes.size());
    if (checked != Failure::none) {
        find(Misuse::bad_description, quoted(desc.label, "size or bytes"));
        return refuse<BufferHandle>(kind, desc.label, desc.size, failure.value_or(checked));
    }
    if (failure) return refuse<BufferHandle>(kind, desc.label, desc.size, *failure);
    if (desc.texels && desc.size > info_.max_texel_bytes)
        return refuse<BufferHandle>(kind, desc.label, desc.size, Failure::out_of_memory);
    RecordedBuffer buffer{desc, {bytes.begin(), bytes.end()}};
    buffer.bytes.resize(desc.size);
    return admit<BufferHandle>(kind, objects_.buffers, desc.label, std::move(buffer), desc.size);
}

Created<ProgramHandle> RecordingDevice::create_program(const ProgramDesc& desc) {
    const auto kind = Kind::create_program;
    ++compiled_;
    const std::optional<Failure> failure = injected(Call::creation, &desc.label);
    const bool draws = !desc.vertex.empty() || !desc.fragment.empty() || !desc.geometry.empty();
    if (desc.compute.empty() ? desc.vertex.empty() : draws) {
        find(Misuse::bad_description, quoted(desc.label, "neither a vertex source nor a compute source alone"));
        return refuse<ProgramHandle>(kind, desc.label, 0, failure.value_or(Failure::compile_failed));
    }
    if (failure) return refuse<ProgramHandle>(kind, desc.label, 0, *failure);
    return admit<ProgramHandle>(kind, objects_.programs, desc.label, desc, 0);
}

Created<TargetHandle> RecordingDevice::create_target(const TargetDesc& desc) {
    const auto kind = Kind::create_target;
    const std::optional<Failure> failure = injected(Call::creation, &desc.label);
    Failure checked = Failure::none;
    const auto check = [&](const Attachment& attachment, bool as_depth) {
        const TextureDesc* texture = find_value(objects_.textures, attachment.texture.id);
        Failure one = check_attachment(attachment, texture);
        if (one == Failure::none && is_depth(texture->format) != as_depth) one = Failure::incomplete_target;
        if (one == Failure::none) return;
        if (one == Failure::invalid_value) {
            find(Misuse::unknown_handle, quoted(desc.label, "names no living texture"));
        } else {
            find(Misuse::incomplete_target, quoted(desc.label, "layer or format of an attachment"));
        }
        if (checked == Failure::none) checked = one;
    };
    for (const Attachment& colour : desc.colours) check(colour, false);
    if (desc.depth.texture) check(desc.depth, true);
    if (desc.colours.empty() && !desc.depth.texture) {
        find(Misuse::incomplete_target, quoted(desc.label, "no attachments"));
        checked = Failure::incomplete_target;
    }
    if (desc.colours.size() > kMaxColourAttachments) {
        find(Misuse::bad_description, quoted(desc.label, "too many colours"));
        checked = Failure::invalid_value;
    }
    if (failure || checked != Failure::none) {
        return refuse<TargetHandle>(kind, desc.label, 0, failure.value_or(checked));
    }
    return admit<TargetHandle>(kind, objects_.targets, desc.label, desc, 0);
}

template <class Map>
void RecordingDevice::remove(Kind kind, Map& map, std::uint32_t id) {
    if (id == 0) return;
    const auto at = map.find(id);
    if (at == map.end()) {
        find(Misuse::unknown_handle, "destroy #" + std::to_string(id));
        return;
    }
    log(kind, id, label_of(at->second), bytes_of(at->second), false);
    map.erase(at);
}

void RecordingDevice::destroy(TextureHandle h) {
    const auto names = [h](const Attachment& a) { return h && a.texture == h; };
    for (const auto& [id, target] : objects_.targets) {
        if (names(target.depth) || std::any_of(target.colours.begin(), target.colours.end(), names)) {
            find(Misuse::destroyed_while_attached, '#' + std::to_string(h.id) + " in target \"" + target.label + '"');
        }
    }
    remove(Kind::destroy_texture, objects_.textures, h.id);
}
void RecordingDevice::destroy(SamplerHandle h) { remove(Kind::destroy_sampler, objects_.samplers, h.id); }
void RecordingDevice::destroy(BufferHandle h) { remove(Kind::destroy_buffer, objects_.buffers, h.id); }
void RecordingDevice::destroy(ProgramHandle h) { remove(Kind::destroy_program, objects_.programs, h.id); }
void RecordingDevice::destroy(TargetHandle h) { remove(Kind::destroy_target, objects_.targets, h.id); }

SubmitResult RecordingDevice::submit(const CommandList& list) {
    const Failure failure = injected(Call::submission, nullptr).value_or(Failure::none);
    const std::uint64_t submission = submitted_++;
    const std::vector<std::uint32_t> timers = check_list(list, submission, info_, objects_, findings_);
    if (timing_ != TimingMode::off) {
        for (const std::uint32_t id : timers) timings_.push_back({id, submission, 0.0});
    }
    lists_.push_back(list);
    log(Kind::submit, static_cast<std::uint32_t>(submission), {}, 0, failure != Failure::none);
    return {failure, submission};
}

bool RecordingDevice::read_texture(TextureHandle texture, std::uint32_t layer, std::span<std::byte> out) {
    const TextureDesc* desc = find_value(objects_.textures, texture.id);
    if (desc == nullptr) {
        find(Misuse::unknown_handle, "read_texture #" + std::to_string(texture.id));
        return false;
    }
    const std::uint64_t needed = std::uint64_t{desc->width} * desc->height * transfer_bytes(desc->format);
    if (layer >= layer_count(*desc) || out.size() != needed) return false;
    std::fill(out.begin(), out.end(), std::byte{0});
    return true;
}

Readback RecordingDevice::read_buffer(BufferHandle handle, std::span<std::byte> out) {
    const std::optional<Failure> failure = injected(Call::reading, nullptr);
    RecordedBuffer* buffer = find_value(objects_.buffers, handle.id);
    log(Kind::read_buffer, handle.id, buffer ? buffer->desc.label : "", out.size(), failure.has_value());
    if (buffer == nullptr) {
        find(Misuse::unknown_handle, "read_buffer #" + std::to_string(handle.id));
        return Readback::failed;
    }
    if (buffer->desc.use != BufferUse::read_back || buffer->desc.size != out.size()) {
        find(Misuse::read_of_other_buffer, quoted(buffer->desc.label, "use or size"));
        return Readback::failed;
    }
    if (failure) {
        buffer->unread = false;
        return Readback::failed;
    }
    if (!buffer->unread) return Readback::empty;
    if (buffer->copied_at >= finished_ && submitted_ <= buffer->copied_at + readback_delay_) return Readback::pending;
    buffer->unread = false;
    const std::vector<std::byte>* source = &buffer->bytes;
    for (const auto& [text, contents] : scripts_)
        if (buffer->desc.label.find(text) != std::string::npos) source = &contents;
    const std::size_t given = std::min(source->size(), out.size());
    std::fill(std::copy_n(source->begin(), given, out.begin()), out.end(), std::byte{0});
    return Readback::done;
}

void RecordingDevice::set_timing(TimingMode mode) { timing_ = mode; }
std::vector<Timing> RecordingDevice::take_timings() { return std::exchange(timings_, {}); }
void RecordingDevice::finish() { finished_ = submitted_; }

}  // namespace gnomon::gl
