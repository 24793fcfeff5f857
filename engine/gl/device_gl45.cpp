#include "engine/gl/device_gl45.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "engine/core/zone.h"
#include "engine/gl/gl45_draw_into.h"
#include "engine/gl/gl45_execute.h"
#include "engine/gl/gl45_info.h"
#include "engine/gl/gl45_kept_state.h"
#include "engine/gl/gl45_manners.h"
#include "engine/gl/gl45_objects.h"
#include "engine/gl/gl45_readbacks.h"
#include "engine/gl/gl45_shared_layers.h"
#include "engine/gl/gl45_timers.h"
#include "engine/gl/validate.h"

namespace gnomon::gl {

namespace {

constexpr int kNeededVersion = 45;  // in epoxy's format: 10 * major + minor

/// Maps OpenGL's severity. A driver's advice on speed is low, because nothing is wrong.
MessageSeverity severity_of(GLenum type, GLenum severity) {
    if (type == GL_DEBUG_TYPE_PERFORMANCE && severity != GL_DEBUG_SEVERITY_NOTIFICATION) return MessageSeverity::low;
    switch (severity) {
        case GL_DEBUG_SEVERITY_HIGH:
            return MessageSeverity::high;
        case GL_DEBUG_SEVERITY_MEDIUM:
            return MessageSeverity::medium;
        case GL_DEBUG_SEVERITY_LOW:
            return MessageSeverity::low;
        default:
            return MessageSeverity::notification;
    }
}

class Gl45Device final : public Device {
public:
    Gl45Device(MessageSink sink, const Gl45Options& options)
        : sink_(std::move(sink)), keeps_state_(options.keeps_state), timers_(options.keeps_state) {
        const GlCall call = enter();
        info_ = read_info();
        if (sink_ && !keeps_state_) {
            glEnable(GL_DEBUG_OUTPUT);
            glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
            glDebugMessageCallback(&Gl45Device::on_message, this);
        }
        robust_ = get_unsigned(GL_RESET_NOTIFICATION_STRATEGY) == GL_LOSE_CONTEXT_ON_RESET;
        fixtures_ = make_fixtures();
        if (keeps_state_)
            state_ = std::make_unique<KeptState>(fixtures_);
        else
            state_ = std::make_unique<GlState>(fixtures_);
    }
    Gl45Device(const Gl45Device&) = delete;
    Gl45Device& operator=(const Gl45Device&) = delete;
    ~Gl45Device() override {
        const GlCall call = enter();
        const bool is_own = gl::is_current(fixtures_);
        for (const auto& [id, target] : objects_.targets)
            if (is_own) glDeleteFramebuffers(1, &target.name);
        for (const auto& [id, texture] : objects_.textures) delete_texture(texture);
        for (const auto& [id, sampler] : objects_.samplers) glDeleteSamplers(1, &sampler);
        for (const auto& [id, buffer] : objects_.buffers) delete_buffer(buffer);
        for (const auto& [id, program] : objects_.programs) glDeleteProgram(program.name);
        if (objects_.plain_sampler != 0) glDeleteSamplers(1, &objects_.plain_sampler);
        if (is_own)
            delete_fixtures(fixtures_);
        else
            timers_.forget();
        if (sink_ && !keeps_state_) glDebugMessageCallback(nullptr, nullptr);
    }

    bool is_current() {
        const GlCall call = enter();
        return gl::is_current(fixtures_) || lost();
    }
    const DeviceInfo& info() const override { return info_; }
    std::uint64_t compiled_programs() const override { return compiled_programs_; }
    std::size_t live_objects() const { return objects_.count(); }
    GLuint name(TextureHandle h) const {
        const GlTexture* texture = find_object(objects_.textures, h.id);
        return texture == nullptr ? 0 : texture->name;
    }
    GLuint name(SamplerHandle h) const {
        const GLuint* sampler = find_object(objects_.samplers, h.id);
        return sampler == nullptr ? 0 : *sampler;
    }
    GLuint name(BufferHandle h) const {
        const GlBuffer* buffer = find_object(objects_.buffers, h.id);
        return buffer == nullptr ? 0 : buffer->name;
    }
    GLuint texels_name(BufferHandle h) const {
        const GlBuffer* buffer = find_object(objects_.buffers, h.id);
        return buffer == nullptr ? 0 : buffer->texels;
    }

    Created<TextureHandle> create_texture(const TextureDesc& desc, std::span<const std::byte> pixels) override {
        const GlCall call = enter();
        const Failure checked = check_texture(desc, info_, pixels.size());
        if (checked != Failure::none) return refused<TextureHandle>(checked, desc.label);
        if (lost()) return refused<TextureHandle>(Failure::context_lost, desc.label);
        if (desc.shared)
            return keep<TextureHandle>(objects_.textures, shared_.make(desc, info_.max_layers, objects_, next_id_));
        return keep<TextureHandle>(objects_.textures, make_texture(desc, pixels, keeps_state_));
    }
    SharedLayers shared_layers(TextureHandle h) const override {
        const GlTexture* texture = find_object(objects_.textures, h.id);
        return texture == nullptr ? SharedLayers{}
                                  : SharedLayers{{texture->array}, texture->first_layer, texture->desc.width};
    }
    Created<SamplerHandle> create_sampler(const SamplerDesc& desc) override {
        const GlCall call = enter();
        if (lost()) return refused<SamplerHandle>(Failure::context_lost, desc.label);
        return keep<SamplerHandle>(objects_.samplers, make_sampler(desc));
    }
    Created<BufferHandle> create_buffer(const BufferDesc& desc, std::span<const std::byte> bytes) override {
        const GlCall call = enter();
        const Failure checked = check_buffer(desc, bytes.size());
        if (checked != Failure::none) return refused<BufferHandle>(checked, desc.label);
        if (lost()) return refused<BufferHandle>(Failure::context_lost, desc.label);
        return keep<BufferHandle>(objects_.buffers, make_buffer(desc, bytes));
    }
    Created<ProgramHandle> create_program(const ProgramDesc& desc) override {
        const GlCall call = enter();
        if (lost()) return refused<ProgramHandle>(Failure::context_lost, desc.label);
        ++compiled_programs_;
        Made<GlProgram> made = make_program(desc);
        if (keeps_state_ && made.failure == Failure::none) made.object.inputs = inputs_of(made.object.name);
        return keep<ProgramHandle>(objects_.programs, std::move(made));
    }
    Created<TargetHandle> create_target(const TargetDesc& desc) override {
        const GlCall call = enter();
        if (lost()) return refused<TargetHandle>(Failure::context_lost, desc.label);
        return keep<TargetHandle>(objects_.targets, make_target(desc, objects_));
    }

    template <class Query>
    auto within_call(Query&& query) const {
        const GlCall call = enter();
        return query();
    }
    bool draw_into(TargetHandle handle, const Rect& viewport, const std::function<void()>& draw) const {
        const GlTarget* target = find_object(objects_.targets, handle.id);
        if (target == nullptr) return false;
        gl::draw_into(*target, viewport, draw);
        return true;
    }
    TextureHandle import(GLuint name, const TextureDesc& desc) {
        const GlCall call = enter();
        if (check_texture(desc, info_, 0) != Failure::none || lost() || !has_plain_sampler()) return {};
        return keep<TextureHandle>(objects_.textures, adopt_texture(name, desc)).handle;
    }
    BufferHandle import(GLuint name, const BufferDesc& desc) {
        const GlCall call = enter();
        if (lost()) return {};
        return keep<BufferHandle>(objects_.buffers, adopt_buffer(name, desc)).handle;
    }

    void destroy(TextureHandle h) override {
        const GlCall call = enter();
        const auto at = objects_.textures.find(h.id);
        if (at == objects_.textures.end()) return;
        const GlTexture texture = std::move(at->second);
        delete_texture(texture);
        objects_.textures.erase(at);
        shared_.release(texture, objects_);
    }
    void destroy(SamplerHandle h) override {
        const GlCall call = enter();
        remove(objects_.samplers, h.id, [](GLuint name) { glDeleteSamplers(1, &name); });
    }
    void destroy(BufferHandle h) override {
        const GlCall call = enter();
        readbacks_.forget(h.id);
        remove(objects_.buffers, h.id, delete_buffer);
    }
    void destroy(ProgramHandle h) override {
        const GlCall call = enter();
        remove(objects_.programs, h.id, [](const GlProgram& program) { glDeleteProgram(program.name); });
    }
    void destroy(TargetHandle h) override {
        const GlCall call = enter();
        remove(objects_.targets, h.id, [&](const GlTarget& target) {
            if (gl::is_current(fixtures_)) glDeleteFramebuffers(1, &target.name);
        });
    }

    SubmitResult submit(const CommandList& list) override {
        GNOMON_ZONE("submit");
        const GlCall call = enter();
        const std::uint64_t submission = submissions_++;
        if (lost()) return {Failure::context_lost, submission};
        drop_gl_errors();
        const Failure failure = execute(list, submission, objects_, *state_, {timers_, readbacks_, uploads_});
        if (lost()) return {Failure::context_lost, submission};
        return {failure, submission};
    }

    bool read_texture(TextureHandle handle, std::uint32_t layer, std::span<std::byte> out) override {
        const GlTexture* texture = find_object(objects_.textures, handle.id);
        if (texture == nullptr || layer >= layer_count(texture->desc)) return false;
        const TextureDesc& desc = texture->desc;
        const std::uint64_t needed = std::uint64_t{desc.width} * desc.height * transfer_bytes(desc.format);
        if (out.size() != needed || needed > std::numeric_limits<GLsizei>::max()) return false;
        const GlCall call = enter();
        if (lost()) return false;
        const GlFormat format = gl_format(desc.format);
        drop_gl_errors();
        const PixelTransfer transfer(keeps_state_, PixelTransfer::Direction::readback);
        // A view is read through its array: NVIDIA 580 returns zeros of views of arrays of depths.
        const GLuint name = texture->array != 0 ? objects_.textures.at(texture->array).name : texture->name;
        glGetTextureSubImage(name, 0, 0, 0, static_cast<GLint>(texture->first_layer + layer),
                             static_cast<GLsizei>(desc.width), static_cast<GLsizei>(desc.height), 1, format.layout,
                             format.type, static_cast<GLsizei>(out.size()), out.data());
        return take_gl_error() == Failure::none;
    }

    Readback read_buffer(BufferHandle handle, std::span<std::byte> out) override {
        const GlCall call = enter();
        const GlBuffer* buffer = find_object(objects_.buffers, handle.id);
        if (buffer == nullptr || buffer->desc.use != BufferUse::read_back || out.size() != buffer->desc.size || lost())
            return Readback::failed;
        drop_gl_errors();
        const Readback state = readbacks_.poll(handle.id);
        if (state != Readback::done) return state;
        glGetNamedBufferSubData(buffer->name, 0, static_cast<GLsizeiptr>(out.size()), out.data());
        return take_gl_error() == Failure::none ? Readback::done : Readback::failed;
    }

    void set_timing(TimingMode mode) override { timers_.set_mode(mode); }
    std::vector<Timing> take_timings() override {
        const GlCall call = enter();
        return timers_.take();
    }
    void finish() override {
        const GlCall call = enter();
        glFinish();
    }

private:
    static void on_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                           const void* self) {
        if (type == GL_DEBUG_TYPE_PUSH_GROUP || type == GL_DEBUG_TYPE_POP_GROUP) return;  // the device's own labels
        static_cast<const Gl45Device*>(self)->sink_(severity_of(type, severity),
                                                    {text, static_cast<std::size_t>(std::max(length, 0))});
    }

    /// Begins a call to the device.
    GlCall enter() const { return {keeps_state_, sink_ ? GlListener{&Gl45Device::on_message, this} : GlListener{}}; }

    /// Returns true if the context is lost, which is permanent. Called before each call that draws or creates.
    bool lost() {
        if (!lost_ && robust_) lost_ = glGetGraphicsResetStatus() != GL_NO_ERROR;
        return lost_;
    }

    bool has_plain_sampler() {
        if (objects_.plain_sampler == 0) objects_.plain_sampler = make_sampler({.label = "plain reads"}).object;
        return objects_.plain_sampler != 0;
    }

    template <class H>
    static Created<H> refused(Failure failure, const std::string& label) {
        return {H{}, failure, '"' + label + "\": " + to_text(failure)};
    }
    template <class H, class Map, class Object>
    Created<H> keep(Map& map, Made<Object> made) {
        if (made.failure != Failure::none) return {H{}, made.failure, std::move(made.log)};
        map.emplace(next_id_, std::move(made.object));
        return {H{next_id_++}};
    }
    template <class Map, class Delete>
    void remove(Map& map, std::uint32_t id, Delete delete_object) {
        const auto at = map.find(id);
        if (at == map.end()) return;
        delete_object(at->second);
        map.erase(at);
    }

    MessageSink sink_;
    bool keeps_state_;
    DeviceInfo info_;
    GlFixtures fixtures_;
    std::unique_ptr<GlState> state_;
    GlObjects objects_;
    SharedArrays shared_;
    GlTimers timers_;
    GlReadbacks readbacks_;
    GlUploads uploads_;
    std::uint32_t next_id_ = 1;
    std::uint64_t submissions_ = 0, compiled_programs_ = 0;
    bool robust_ = false, lost_ = false;
};

}  // namespace

Result<std::unique_ptr<Device>> make_gl45_device(MessageSink sink, const Gl45Options& options) {
    const int version = epoxy_is_desktop_gl() ? epoxy_gl_version() : 0;
    if (version < kNeededVersion) {
        return Error{"the current context is not OpenGL 4.5 (docs/reference/limits.md) but " + get_string(GL_VERSION),
                     {},
                     {},
                     "gl.version"};
    }
    return std::unique_ptr<Device>{std::make_unique<Gl45Device>(std::move(sink), options)};
}

/// Returns of(device) of an OpenGL device; an empty value of any other.
template <class Of>
static auto of_gl45(const Device& device, Of&& of) {
    const auto* gl45 = dynamic_cast<const Gl45Device*>(&device);
    return gl45 == nullptr ? decltype(of(*gl45)){} : of(*gl45);
}

bool is_current(Device& gl45_device) {
    auto* device = dynamic_cast<Gl45Device*>(&gl45_device);
    return device != nullptr && device->is_current();
}
unsigned gl_name(const Device& gl45_device, TextureHandle texture) {
    return of_gl45(gl45_device, [&](const Gl45Device& device) { return device.name(texture); });
}
unsigned gl_name(const Device& gl45_device, SamplerHandle sampler) {
    return of_gl45(gl45_device, [&](const Gl45Device& device) { return device.name(sampler); });
}
unsigned gl_name(const Device& gl45_device, BufferHandle buffer) {
    return of_gl45(gl45_device, [&](const Gl45Device& device) { return device.name(buffer); });
}
unsigned gl_texels_name(const Device& gl45_device, BufferHandle buffer) {
    return of_gl45(gl45_device, [&](const Gl45Device& device) { return device.texels_name(buffer); });
}
std::optional<EngineTexture> describe_texture(const Device& gl45_device, unsigned name) {
    return of_gl45(gl45_device,
                   [&](const Gl45Device& device) { return device.within_call([&] { return described(name); }); });
}
std::vector<std::array<float, 2>> sample_positions(const Device& gl45_device, unsigned name) {
    return of_gl45(gl45_device, [&](const Gl45Device& device) {
        return device.within_call([&] { return places_of_samples(name); });
    });
}
void bind_for_engine(const Device& gl45_device, std::span<const EngineBinding> bindings) {
    for (const EngineBinding& b : bindings) {
        switch (b.kind) {
            case EngineBinding::Kind::texture:
                glBindTextureUnit(b.place, gl_name(gl45_device, b.texture));
                glBindSampler(b.place, gl_name(gl45_device, b.sampler));
                break;
            case EngineBinding::Kind::texels:
                glBindTextureUnit(b.place, gl_texels_name(gl45_device, b.buffer));
                glBindSampler(b.place, 0);
                break;
            case EngineBinding::Kind::storage: {
                const GLuint name = gl_name(gl45_device, b.buffer);
                glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, b.place, 1, &name);  // leaves the generic binding alone
                break;
            }
        }
    }
}
bool draw_into(Device& gl45_device, TargetHandle target, const Rect& viewport, const std::function<void()>& draw) {
    const auto* device = dynamic_cast<const Gl45Device*>(&gl45_device);
    return device != nullptr && device->draw_into(target, viewport, draw);
}
TextureHandle import_texture(Device& gl45_device, unsigned name, const TextureDesc& desc) {
    auto* device = dynamic_cast<Gl45Device*>(&gl45_device);
    return device == nullptr ? TextureHandle{} : device->import(name, desc);
}
void buffer_sizes(const Device& gl45_device, std::span<const unsigned> names, std::span<std::uint64_t> sizes) {
    const auto sizes_of = [&] { return std::transform(names.begin(), names.end(), sizes.begin(), size_of_buffer); };
    if (!names.empty()) of_gl45(gl45_device, [&](const Gl45Device& device) { return device.within_call(sizes_of); });
}
BufferHandle import_buffer(Device& gl45_device, unsigned name, const BufferDesc& desc) {
    auto* device = dynamic_cast<Gl45Device*>(&gl45_device);
    return device == nullptr ? BufferHandle{} : device->import(name, desc);
}

std::size_t live_objects(const Device& gl45_device) {
    return of_gl45(gl45_device, [](const Gl45Device& device) { return device.live_objects(); });
}

}  // namespace gnomon::gl
