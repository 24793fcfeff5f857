#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/device.h"

namespace gnomon::gl {

/// Kind of misuse that the recording device found. Tests assert which.
enum class Misuse : std::uint8_t {
    unknown_handle,  // never created, or already destroyed; {0} where an object is needed
    draw_outside_pass,
    nested_pass,
    unbalanced_pass,
    unbalanced_group,
    unbalanced_timer,
    nested_timer,
    draw_without_pipeline,
    draw_without_meshes,
    draw_out_of_range,  // indices, vertices or items beyond the buffer
    wrong_program,      // a compute program draws, or a drawing program is dispatched
    dispatch_inside_pass,
    dispatch_of_nothing,  // no work groups
    copy_inside_pass,
    copy_mismatch,         // sizes, formats or ranges, source is destination, no such layer, or a fixed buffer
    read_of_other_buffer,  // not BufferUse::read_back, or a wrong size
    update_inside_pass,
    update_out_of_range,
    update_of_fixed_buffer,  // or of a read_back buffer, which only copies may write
    buffer_without_texels,   // bound as texels
    uniform_misaligned,
    uniform_out_of_range,
    viewport_out_of_target,    // also blit rectangles; a scissor of negative size
    incomplete_target,         // no attachments, a wrong layer, colour given as depth or depth as colour
    feedback_loop,             // the pass draws into a texture that is bound, mipped or blitted meanwhile
    destroyed_while_attached,  // a target still names the texture
    bad_description,           // zero size, non-square cube, beyond a limit, wrong number of bytes
    leak                       // reported by check_leaks()
};
const char* to_text(Misuse misuse);

struct Finding {
    Misuse misuse;
    std::string detail;
};

/// Resource call, in order of arrival.
struct ResourceCall {
    enum class Kind : std::uint8_t {
        create_texture,
        create_sampler,
        create_buffer,
        create_program,
        create_target,
        destroy_texture,
        destroy_sampler,
        destroy_buffer,
        destroy_program,
        destroy_target,
        submit,
        read_buffer
    };
    Kind kind;
    std::uint32_t id = 0;  // id of the object; submit: number of the submission
    std::string label;
    std::uint64_t bytes = 0;
    bool failed = false;
    bool operator==(const ResourceCall&) const = default;
};

/// Object of a recording device, by id.
struct RecordedBuffer {
    BufferDesc desc;
    std::vector<std::byte> bytes;
    bool unread = false;          // read_back: has a copy since the last read
    std::uint64_t copied_at = 0;  // number of that copy's submission
};
struct RecordedObjects {
    std::map<std::uint32_t, TextureDesc> textures;
    std::map<std::uint32_t, SamplerDesc> samplers;
    std::map<std::uint32_t, RecordedBuffer> buffers;
    std::map<std::uint32_t, ProgramDesc> programs;
    std::map<std::uint32_t, TargetDesc> targets;
};

/// Walks the list like a device. Appends misuse to `findings`, applies buffer updates and copies to `objects`. Returns
/// the ids of the list's timers in order. `submission` is the list's number.
std::vector<std::uint32_t> check_list(const CommandList& list, std::uint64_t submission, const DeviceInfo& info,
                                      RecordedObjects& objects, std::vector<Finding>& findings);

/// Device without a GPU. Hands out fake handles, keeps every list, validates lifetimes and use, counts live objects and
/// bytes. Can fail the nth resource call.
class RecordingDevice final : public Device {
public:
    explicit RecordingDevice(DeviceInfo info = default_info());
    static DeviceInfo default_info();  // "recording", limits as llvmpipe: 16384 px, 2048 layers

    /// Makes call number `index` fail. Numbers count all create_*, submit and read_buffer calls since construction,
    /// from 0. A call that fails with context_lost loses the context: all later calls fail likewise.
    void fail_call(std::uint64_t index, Failure failure);
    /// Makes that call and all later ones fail until stop_failing(). If `submissions` is false, only creations fail.
    void fail_from(std::uint64_t index, Failure failure, bool submissions);
    /// Makes every create_texture, create_buffer, create_target and create_program fail if its label contains `text`.
    void fail_label(std::string text, Failure failure);
    void stop_failing();
    std::uint64_t calls() const;  // create_*, submit and read_buffer calls so far

    /// Replaces the GPU's output: contents that read_buffer returns for buffers with `text` in their label. Cut or
    /// padded with zeros to the buffer's size. Without a script read_buffer returns what was copied.
    void script_readback(std::string text, std::vector<std::byte> contents);
    /// Keeps copies `pending` for this number of submissions after their own (default 0). finish() completes them.
    void delay_readbacks(std::uint64_t submissions);

    const std::vector<ResourceCall>& resource_calls() const;
    const std::vector<CommandList>& submissions() const;
    const std::vector<Finding>& findings() const;  // misuse found; empty is right
    void forget();                                 // drops kept lists, calls and findings, not live objects

    std::size_t live_count() const;
    std::uint64_t live_bytes() const;                 // textures and buffers
    std::vector<std::string> live_labels() const;     // sorted
    const TextureDesc* texture(TextureHandle) const;  // nullptr if not alive
    const TargetDesc* target(TargetHandle) const;
    const BufferDesc* buffer(BufferHandle) const;
    const ProgramDesc* program(ProgramHandle) const;
    std::span<const std::byte> buffer_bytes(BufferHandle) const;  // current contents, updates applied
    void check_leaks();                                           // adds a finding per live object

    // Device
    const DeviceInfo& info() const override;
    std::uint64_t compiled_programs() const override;
    Created<TextureHandle> create_texture(const TextureDesc&, std::span<const std::byte>) override;
    Created<SamplerHandle> create_sampler(const SamplerDesc&) override;
    Created<BufferHandle> create_buffer(const BufferDesc&, std::span<const std::byte>) override;
    Created<ProgramHandle> create_program(const ProgramDesc&) override;
    Created<TargetHandle> create_target(const TargetDesc&) override;
    void destroy(TextureHandle) override;
    void destroy(SamplerHandle) override;
    void destroy(BufferHandle) override;
    void destroy(ProgramHandle) override;
    void destroy(TargetHandle) override;
    SubmitResult submit(const CommandList&) override;
    bool read_texture(TextureHandle, std::uint32_t layer, std::span<std::byte> out) override;  // zeros
    Readback read_buffer(BufferHandle, std::span<std::byte> out) override;
    void set_timing(TimingMode) override;
    std::vector<Timing> take_timings() override;  // 0 us per timer if timing is on
    void finish() override;

private:
    enum class Call : std::uint8_t { creation, submission, reading };
    std::optional<Failure> injected(Call call, const std::string* label);
    std::optional<Failure> scheduled(std::uint64_t index, Call call, const std::string* label) const;
    void find(Misuse misuse, std::string detail);
    void log(ResourceCall::Kind kind, std::uint32_t id, std::string label, std::uint64_t bytes, bool failed);
    template <class H, class Map, class Value>
    Created<H> admit(ResourceCall::Kind kind, Map& map, std::string label, Value value, std::uint64_t bytes);
    template <class H>
    Created<H> refuse(ResourceCall::Kind kind, const std::string& label, std::uint64_t bytes, Failure failure);
    template <class Map>
    void remove(ResourceCall::Kind kind, Map& map, std::uint32_t id);

    DeviceInfo info_;
    RecordedObjects objects_;
    std::uint32_t next_id_ = 1;  // one sequence for all kinds: a handle cast to another kind is unknown
    std::uint64_t calls_ = 0;
    std::uint64_t submitted_ = 0;
    std::uint64_t compiled_ = 0;
    struct LastingFault {
        std::uint64_t first;
        Failure failure;
        bool submissions;
    };
    std::map<std::uint64_t, Failure> failing_calls_;
    std::optional<LastingFault> lasting_fault_;
    bool lost_ = false;
    std::vector<std::pair<std::string, Failure>> failing_labels_;
    std::vector<std::pair<std::string, std::vector<std::byte>>> scripts_;
    std::uint64_t readback_delay_ = 0, finished_ = 0;  // numbers of submissions
    std::vector<ResourceCall> log_;
    std::vector<CommandList> lists_;
    std::vector<Finding> findings_;
    TimingMode timing_ = TimingMode::off;
    std::vector<Timing> timings_;
};

}  // namespace gnomon::gl
