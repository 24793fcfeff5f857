#include <epoxy/gl.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "engine/gl/program_cache.h"
#include "tests/gl/gl_test_context.h"
#include "tests/own_folder.h"

/// Linked programs out of a folder, on the real driver.
namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVertex = R"(#version 450 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})";
/// With a texture, a block and a buffer whose places are said in the source alone.
constexpr const char* kFragment = R"(#version 450 core
layout(binding = 3) uniform sampler2D picture;
layout(std140, binding = 2) uniform Block { vec4 colour; };
layout(std430, binding = 1) buffer Numbers { float numbers[]; };
layout(location = 0) out vec4 colour_out;
void main() { colour_out = colour * texelFetch(picture, ivec2(0), 0).r + numbers[1]; })";
constexpr const char* kCompute = R"(#version 450 core
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Numbers { float numbers[]; };
void main() { numbers[0] = 1.0; })";

class ProgramCacheGl : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        GLint formats = 0;
        glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
        if (formats == 0) GTEST_SKIP() << "this driver gives no program binaries";
    }
    /// Makes both programs on a device of their own, draws with the first, and gives back what was counted and drawn.
    gl::ProgramCounts make_and_draw(std::array<float, 4>& pixel) {
        auto cached = gl::make_gl45_device({}, folder);
        EXPECT_TRUE(cached);
        gl::Device& with = *cached.value();
        const auto program = with.create_program({"draws", kVertex, kFragment});
        const auto counts = with.create_program({.label = "counts", .compute = kCompute});
        EXPECT_TRUE(program && counts) << program.log << counts.log;
        const float half = 0.5f;
        const std::array<float, 4> colour = {0.25f, 0.5f, 0.75f, 1.0f}, numbers = {0.0f, 2.0f, 0.0f, 0.0f};
        const auto picture = with.create_texture({.label = "picture", .format = gl::Format::r32f},
                                                 std::as_bytes(std::span(&half, 1)));
        const auto block = with.create_buffer({"block", sizeof colour, gl::BufferUse::fixed}, std::as_bytes(std::span(colour)));
        const auto list_of = with.create_buffer({"numbers", sizeof numbers, gl::BufferUse::fixed}, std::as_bytes(std::span(numbers)));
        const auto texture = with.create_texture({.label = "target", .format = gl::Format::rgba32f}, {});
        const auto target = with.create_target({"target", {{texture.handle, -1}}, {}});
        gl::CommandList list;
        list.add(gl::BeginPass{target.handle, {0, 0, 1, 1}});
        list.add(gl::SetPipeline{{program.handle}});
        list.add(gl::BindTexture{3, picture.handle, {}});
        list.add(gl::BindUniforms{2, block.handle, 0, sizeof colour});
        list.add(gl::BindStorage{1, list_of.handle});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        EXPECT_EQ(with.submit(list).failure, gl::Failure::none);
        EXPECT_TRUE(with.read_texture(texture.handle, 0, std::as_writable_bytes(std::span(pixel))));
        return with.program_counts();
    }
    void expect_made(const gl::ProgramCounts& wanted, const char* when) {
        std::array<float, 4> pixel{};
        EXPECT_EQ(make_and_draw(pixel), wanted) << when << ": programs compiled, programs out of the cache";
        EXPECT_EQ(pixel, (std::array<float, 4>{2.125f, 2.25f, 2.375f, 2.5f})) << when;
        EXPECT_TRUE(take_messages().empty()) << when;
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> all;
        for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
        return all;
    }
    OwnFolder own;
    const fs::path& folder = own.path();
};

TEST_F(ProgramCacheGl, HasThemForTheNextDeviceAndTheyDrawTheSame) {
    expect_made({2, 0}, "first");
    EXPECT_EQ(files().size(), 2u);
    expect_made({0, 2}, "second");
    expect_made({0, 2}, "third");
}

TEST_F(ProgramCacheGl, CompilesAnewWhatIsCorrupt) {
    expect_made({2, 0}, "first");
    for (const fs::path& file : files()) fs::resize_file(file, fs::file_size(file) / 2);
    expect_made({2, 0}, "cut");
    expect_made({0, 2}, "kept again");
    for (const fs::path& file : files()) std::ofstream(file, std::ios::binary | std::ios::trunc) << "foreign";
    expect_made({2, 0}, "foreign");
}

// Files that are right for the cache, and yet no binary of this driver: the driver itself has to say so.
TEST_F(ProgramCacheGl, CompilesAnewWhatTheDriverRefuses) {
    expect_made({2, 0}, "first");
    std::string driver;
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION})
        driver += std::string(reinterpret_cast<const char*>(glGetString(name))) + '\n';
    const gl::ProgramCache cache(folder, driver);
    const gl::ProgramDesc desc{"draws", kVertex, kFragment};
    const auto sound = cache.find(desc);
    ASSERT_TRUE(sound) << "the driver's identity is not what the device made it of";
    std::vector<gl::ProgramCache::Binary> wrong(4, *sound);
    wrong[0].format = 0xffff;
    wrong[1].bytes.resize(wrong[1].bytes.size() / 2);
    wrong[2].bytes.assign(wrong[2].bytes.size(), std::byte{0xa5});
    wrong[3].bytes.back() ^= std::byte{1};
    for (const auto& binary : wrong) {
        ASSERT_TRUE(cache.keep(desc, binary));
        expect_made({1, 1}, "refused");
        EXPECT_EQ(cache.find(desc), sound) << "kept again";
    }
}

TEST_F(ProgramCacheGl, KeepsNothingThatDoesNotCompile) {
    auto cached = gl::make_gl45_device({}, folder);
    ASSERT_TRUE(cached);
    for (std::uint64_t i = 1; i < 3; ++i) {
        EXPECT_EQ(cached.value()->create_program({"bad", kVertex, "#version 450 core\nvoid main( {}\n"}).failure,
                  gl::Failure::compile_failed);
        EXPECT_EQ(cached.value()->program_counts(), (gl::ProgramCounts{i, 0}));
    }
    take_messages();
    EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace gnomon
