#include "bench/accuracy/rasterised_triangle_ids.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <variant>

#include "engine/gl/shader_source.h"
#include "shaders/embedded.h"

namespace gnomon::bench {
namespace {

using oracle::PlacedTriangle;

constexpr std::string_view kFragmentPath = "bench/drawn_triangles.frag";
/// Writes instance and triangle, found as lighting/gbuffer/gbuffer.frag finds them. The instance's number is one more
/// than its index: 0 is the cleared value.
constexpr std::string_view kFragment =
    "#include \"common/material.glsl\"\n"
    R"(
layout(location = kUvVarying) in vec2 fragment_uv;
layout(location = kItemVarying) flat in uvec2 fragment_item;
layout(location = 0) out uvec2 triangle_out;

void main() {
    if (cut_out(fragment_uv)) discard;
    triangle_out = uvec2(fragment_item.x + 1u, fragment_item.y + uint(gl_PrimitiveID));
}
)";

Error failed(const std::string& what) { return {what, "", "", "bench.surfaces"}; }

/// Returns the commands of the frame's surface pass, from its BeginPass to its EndPass.
std::span<const gl::Command> surface_pass(const gl::CommandList& list) {
    const auto named = std::find_if(list.commands.begin(), list.commands.end(), [](const gl::Command& command) {
        const auto* group = std::get_if<gl::BeginGroup>(&command);
        return group && group->label == "surfaces";
    });
    const auto is_begin = [](const gl::Command& c) { return std::holds_alternative<gl::BeginPass>(c); };
    const auto is_end = [](const gl::Command& c) { return std::holds_alternative<gl::EndPass>(c); };
    const auto begin = std::find_if(named, list.commands.end(), is_begin);
    const auto end = std::find_if(begin, list.commands.end(), is_end);
    return end == list.commands.end() ? std::span<const gl::Command>{} : std::span(begin, end + 1);
}

/// Returns the depths of the surfaces: the first texture that measuring of the exposure reads.
gl::TextureHandle surface_depth(const gl::CommandList& list) {
    bool in_group = false;
    for (const gl::Command& command : list.commands) {
        if (const auto* group = std::get_if<gl::BeginGroup>(&command)) in_group = group->label == "exposure";
        if (const auto* bind = std::get_if<gl::BindTexture>(&command); bind && in_group && bind->unit == 0)
            return bind->texture;
    }
    return {};
}

/// Objects of the device for one picture of numbers.
class NumberPicture {
public:
    explicit NumberPicture(gl::Device& device) : device_(device) {}
    ~NumberPicture() {
        device_.destroy(target_);
        device_.destroy(numbers_);
        device_.destroy(depth_);
        device_.destroy(program_);
    }
    NumberPicture(const NumberPicture&) = delete;
    NumberPicture& operator=(const NumberPicture&) = delete;

    std::optional<Error> make(glm::uvec2 size_px) {
        std::vector<gl::ShaderFile> files(shader_files().begin(), shader_files().end());
        files.push_back({kFragmentPath, kFragment});
        const auto vertex = gl::expand_shader(files, "lighting/gbuffer/gbuffer.vert", {});
        const auto fragment = gl::expand_shader(files, kFragmentPath, {});
        if (!vertex) return vertex.error();
        if (!fragment) return fragment.error();
        const auto keep = [](auto& handle, const auto& created) {
            handle = created.handle;
            return static_cast<bool>(created);
        };
        const auto texture = [&](const char* label, gl::Format format) {
            return device_.create_texture({label, gl::TextureKind::flat, format, size_px.x, size_px.y}, {});
        };
        const bool made =
            keep(program_, device_.create_program({"drawn triangles", vertex.value(), fragment.value()})) &&
            keep(numbers_, texture("drawn triangles", gl::Format::rg32ui)) &&
            keep(depth_, texture("drawn triangles' depth", gl::Format::d32f)) &&
            keep(target_, device_.create_target({"drawn triangles", {{numbers_, -1}}, {depth_, -1}}));
        return made ? std::nullopt : std::optional(failed("the device cannot draw numbers of triangles"));
    }

    bool draw(std::span<const gl::Command> pass) {
        gl::CommandList list;
        for (gl::Command command : pass) {
            if (auto* begin = std::get_if<gl::BeginPass>(&command)) begin->target = target_;
            if (auto* pipeline = std::get_if<gl::SetPipeline>(&command)) pipeline->state.program = program_;
            list.add(std::move(command));
        }
        return device_.submit(list).failure == gl::Failure::none;
    }

    bool read(std::vector<glm::uvec2>& numbers) {
        return device_.read_texture(numbers_, 0, std::as_writable_bytes(std::span(numbers)));
    }
    gl::TextureHandle depth() const { return depth_; }

private:
    gl::Device& device_;
    gl::ProgramHandle program_{};
    gl::TextureHandle numbers_{}, depth_{};
    gl::TargetHandle target_{};
};

/// From what the device numbers to what the scene does.
class TriangleNames {
public:
    TriangleNames(const SceneSnapshot& scene, const assets::MeshLibrary& library) : scene_(scene) {
        instance_of_slot_.resize(scene.gpu_slot_count, oracle::kNoTriangle);
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].gpu_slot < instance_of_slot_.size())
                instance_of_slot_[scene.instances[i].gpu_slot] = i;
        // The common index buffer holds the meshes one after another (GpuScene).
        std::uint32_t triangles = 0;
        for (const assets::Mesh& mesh : library.meshes) {
            first_triangle_.push_back(triangles);
            triangles += static_cast<std::uint32_t>(mesh.indices.size() / 3);
        }
    }

    PlacedTriangle of(const glm::uvec2& number) const {
        if (number.x == 0 || number.x > instance_of_slot_.size()) return {};
        const std::uint32_t instance = instance_of_slot_[number.x - 1];
        if (instance == oracle::kNoTriangle) return {};
        return {instance, number.y - first_triangle_[scene_.instances[instance].mesh]};
    }

private:
    const SceneSnapshot& scene_;
    std::vector<std::uint32_t> instance_of_slot_, first_triangle_;
};

bool read_depth(gl::Device& device, gl::TextureHandle texture, std::vector<float>& depth) {
    return texture && device.read_texture(texture, 0, std::as_writable_bytes(std::span(depth)));
}

}  // namespace

Result<std::vector<oracle::PlacedTriangle>> drawn_triangles(gl::Device& device, const FrameSystem& frame,
                                                            const assets::MeshLibrary& library) {
    const SceneSnapshot& scene = frame.snapshot();
    const std::span<const gl::Command> pass = surface_pass(frame.commands());
    if (pass.empty() || scene.consumers.empty()) return failed("there is no picture");
    const glm::uvec2 size_px = scene.consumers.front().viewport_px;
    NumberPicture picture(device);
    if (auto error = picture.make(size_px)) return *error;
    const std::size_t count = std::size_t{size_px.x} * size_px.y;
    std::vector<glm::uvec2> numbers(count);
    std::vector<float> depth(count), frame_depth(count);
    if (!picture.draw(pass) || !picture.read(numbers) || !read_depth(device, picture.depth(), depth) ||
        !read_depth(device, surface_depth(frame.commands()), frame_depth))
        return failed("the surfaces cannot be drawn again");
    if (std::memcmp(depth.data(), frame_depth.data(), count * sizeof(float)) != 0)
        return failed("the surfaces that were drawn again are not those of the picture");
    const TriangleNames names(scene, library);
    std::vector<PlacedTriangle> drawn;
    drawn.reserve(count);
    for (const glm::uvec2& number : numbers) drawn.push_back(names.of(number));
    return drawn;
}

}  // namespace gnomon::bench
