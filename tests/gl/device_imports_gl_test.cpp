#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "tests/gl/device_fixture.h"

// An engine's own textures and buffers in command lists.
namespace gnomon {
namespace {

using gl::Format;
using gl::TextureKind;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::Not;

/// Objects of the engine, made without the device.
class DeviceImports : public DeviceTest {
protected:
    static GLuint engine_texture(GLenum target, GLenum internal, GLsizei layers = 1, GLsizei levels = 1) {
        GLuint name = 0;
        glCreateTextures(target, 1, &name);
        if (target == GL_TEXTURE_2D_ARRAY)
            glTextureStorage3D(name, levels, internal, 16, 16, layers);
        else if (target == GL_TEXTURE_2D_MULTISAMPLE)
            glTextureStorage2DMultisample(name, 4, internal, 16, 16, GL_TRUE);
        else
            glTextureStorage2D(name, levels, internal, 16, 16);
        return name;
    }
    /// Sets texel (x, y) to (16 x + y) / 255, which every format holds to a fraction of 1 / 255.
    static void fill_depth(GLuint name) {
        std::vector<float> ramp;
        for (int i = 0; i < 256; ++i) ramp.push_back(ramp_at(i % 16, i / 16));
        glTextureSubImage2D(name, 0, 0, 0, 16, 16, GL_DEPTH_COMPONENT, GL_FLOAT, ramp.data());
    }
    static float ramp_at(int x, int y) { return static_cast<float>(16 * x + y) / 255.0f; }
    gl::TextureHandle imported(GLuint name, const gl::TextureDesc& desc) {
        const gl::TextureHandle handle = gl::import_texture(device(), name, desc);
        return keep(gl::Created<gl::TextureHandle>{handle, handle ? gl::Failure::none : gl::Failure::invalid_value,
                                                   desc.label});
    }
    /// Writes `expression` of an imported texture `map` at unit 4 into all of the colour target.
    void draw_reading(gl::TextureHandle map, const std::string& sampler, const std::string& expression) {
        const auto program = full_screen("ivec2 at = ivec2(gl_FragCoord.xy); result = vec4(" + expression + ");",
                                         "layout(binding = 4) uniform " + sampler + " map;");
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::BindTexture{4, map, {}});
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::DrawTriangle{});
        list.add(gl::EndPass{});
        run(list);
    }
    void expect_ramp() {
        const auto image = pixels();
        for (std::uint32_t y = 0; y < kSize_px; ++y)
            for (std::uint32_t x = 0; x < kSize_px; ++x) ASSERT_EQ(at(image, x, y)[0], 16 * x + y) << x << ", " << y;
    }
    static gl::TextureDesc desc_of(Format format) {
        return {.label = "the engine's", .format = format, .width = kSize_px, .height = kSize_px};
    }
};

struct DepthRow {
    const char* name;
    GLenum internal;
    Format format;
};
class ImportedDepth : public DeviceImports, public ::testing::WithParamInterface<DepthRow> {};

TEST_P(ImportedDepth, IsReadTexelByTexel) {
    const GLuint name = engine_texture(GL_TEXTURE_2D, GetParam().internal);
    fill_depth(name);
    // What engines leave on their depth buffers, and would make plain reads undefined.
    glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    const auto map = imported(name, desc_of(GetParam().format));
    draw_reading(map, "sampler2D", "texelFetch(map, at, 0).r");
    expect_ramp();
    const std::vector<float> back = read<float>(map, kTexels);
    EXPECT_NEAR(back[1], 16.0 / 255.0, 1.0 / 65535.0);
    device().destroy(map);
    EXPECT_EQ(glIsTexture(name), GL_TRUE) << "the engine's texture was deleted";
    glDeleteTextures(1, &name);
}

TEST_P(ImportedDepth, OfNoFixedSizeIsWhatTheDriverChose) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    const bool stencil = GetParam().format == Format::d24_s8 || GetParam().format == Format::d32f_s8;
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(GetParam().internal), 16, 16, 0,
                 stencil ? GL_DEPTH_STENCIL : GL_DEPTH_COMPONENT,
                 GetParam().format == Format::d32f_s8 ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV
                 : stencil                            ? GL_UNSIGNED_INT_24_8
                                                      : GL_FLOAT,
                 nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    fill_depth(name);
    // Default filters name mipmaps that this texture lacks: without a sampler every read would be 0.
    draw_reading(imported(name, desc_of(GetParam().format)), "sampler2D", "texelFetch(map, at, 0).r");
    expect_ramp();
    glDeleteTextures(1, &name);
}

INSTANTIATE_TEST_SUITE_P(All, ImportedDepth,
                         ::testing::Values(DepthRow{"d16", GL_DEPTH_COMPONENT16, Format::d16},
                                           DepthRow{"d24", GL_DEPTH_COMPONENT24, Format::d24},
                                           DepthRow{"d24_s8", GL_DEPTH24_STENCIL8, Format::d24_s8},
                                           DepthRow{"d32f", GL_DEPTH_COMPONENT32F, Format::d32f},
                                           DepthRow{"d32f_s8", GL_DEPTH32F_STENCIL8, Format::d32f_s8}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST_F(DeviceImports, UnsizedDepthIsTakenByItsBits) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 16, 16, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    GLint bits = 0;
    glGetTextureLevelParameteriv(name, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    const Format right = bits == 16 ? Format::d16 : Format::d24, wrong = bits == 16 ? Format::d24 : Format::d16;
    EXPECT_EQ(static_cast<bool>(gl::import_texture(device(), name, desc_of(wrong))), false);
    if (bits <= 24) imported(name, desc_of(right));
    glDeleteTextures(1, &name);
}

TEST_F(DeviceImports, AMultisampledDepthBufferIsReadSampleBySample) {
    const GLuint name = engine_texture(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, name, 0);
    const float value = 0.2f;
    glDepthMask(GL_TRUE);
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &value);
    const auto map = imported(name, desc_of(Format::d32f));
    draw_reading(map, "sampler2DMS", "texelFetch(map, at, 3).r");
    EXPECT_THAT(pixels(), Each(Rgba{51, 51, 51, 51}));
    const auto copy = keep(device().create_texture(desc_of(Format::d32f), {}));
    gl::CommandList list;
    list.add(gl::CopyTexture{map, copy, 0});
    EXPECT_NE(device().submit(list).failure, gl::Failure::none) << "samples are no texels";
    EXPECT_THAT(take_messages(), Not(IsEmpty()));
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &name);
}

TEST_F(DeviceImports, AnEnginesColourIsDrawnIntoAndCopied) {
    const GLuint name = engine_texture(GL_TEXTURE_2D_ARRAY, GL_RGBA8, 3, 2);
    gl::TextureDesc desc = desc_of(Format::rgba8);
    desc.kind = TextureKind::array;
    desc.layers = 3;
    desc.mips = 2;
    const auto picture = imported(name, desc);
    const auto into = keep(device().create_target({.label = "into the engine's", .colours = {{picture, 2}}}));
    const auto copy = keep(device().create_texture(desc, {}));
    gl::CommandList list;
    list.add(clearing(into, {0.0f, 1.0f, 0.0f, 1.0f}));
    list.add(gl::EndPass{});
    list.add(gl::CopyTexture{picture, copy, 2});
    run(list);
    EXPECT_THAT(read<Rgba>(picture, kTexels, 2), Each(Rgba{0, 255, 0, 255}));
    EXPECT_THAT(read<Rgba>(copy, kTexels, 2), Each(Rgba{0, 255, 0, 255}));
    EXPECT_EQ(gl::gl_name(device(), picture), name);
    device().destroy(into);
    device().destroy(picture);
    glDeleteTextures(1, &name);
}

TEST_F(DeviceImports, WhatADescriptionGetsWrongIsRefused) {
    const GLuint name = engine_texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT24);
    const std::size_t live = gl::live_objects(device());
    gl::TextureDesc wide = desc_of(Format::d24), array = wide, cube = wide;
    wide.width = 17;
    array.kind = TextureKind::array;
    cube.kind = TextureKind::cube;
    for (const gl::TextureDesc& wrong : {wide, array, cube, desc_of(Format::d32f), desc_of(Format::rgba8)})
        EXPECT_FALSE(gl::import_texture(device(), name, wrong));
    EXPECT_FALSE(gl::import_texture(device(), 0, desc_of(Format::d24)));
    EXPECT_FALSE(gl::import_texture(device(), 4711, desc_of(Format::d24)));
    EXPECT_EQ(gl::live_objects(device()), live);
    imported(name, desc_of(Format::d24));
    EXPECT_EQ(gl::live_objects(device()), live + 1) << "the right description is taken";
    glDeleteTextures(1, &name);
}

TEST_F(DeviceImports, ADeviceLeavesTheEnginesObjectsWhenItEnds) {
    const GLuint name = engine_texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT24);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 64, nullptr, 0);
    auto second = gl::make_gl45_device({});
    ASSERT_TRUE(second);
    EXPECT_TRUE(gl::import_texture(*second.value(), name, desc_of(Format::d24)));
    EXPECT_TRUE(gl::import_buffer(*second.value(), buffer,
                                  {.label = "the engine's", .size = 64, .use = gl::BufferUse::fixed, .texels = true}));
    std::move(second).value().reset();
    EXPECT_EQ(glIsTexture(name), GL_TRUE);
    EXPECT_EQ(glIsBuffer(buffer), GL_TRUE);
    glDeleteTextures(1, &name);
    glDeleteBuffers(1, &buffer);
}

/// Draws a quad as a mesh from buffers that the engine made.
TEST_F(DeviceImports, MeshesAreDrawnFromTheEnginesBuffers) {
    const std::vector<float> corners = {-1, -1, 0.5f, 0, 0, 1, 0, 0, 1,  -1, 0.5f, 0, 0, 1, 0, 0,
                                        1,  1,  0.5f, 0, 0, 1, 0, 0, -1, 1,  0.5f, 0, 0, 1, 0, 0};
    const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 2, 3};
    GLuint names[2] = {};
    glCreateBuffers(2, names);
    glNamedBufferStorage(names[0], static_cast<GLsizeiptr>(corners.size() * sizeof(float)), corners.data(), 0);
    glNamedBufferData(names[1], static_cast<GLsizeiptr>(triangles.size() * 4), triangles.data(), GL_STATIC_DRAW);
    const auto take = [&](GLuint name, std::uint64_t bytes, gl::BufferUse use) {
        const gl::BufferHandle handle =
            gl::import_buffer(device(), name, {.label = "the engine's", .size = bytes, .use = use});
        return keep(gl::Created<gl::BufferHandle>{handle, handle ? gl::Failure::none : gl::Failure::invalid_value, {}});
    };
    const auto vertices = take(names[0], corners.size() * sizeof(float), gl::BufferUse::fixed);
    const auto indices = take(names[1], triangles.size() * 4, gl::BufferUse::updated);
    const auto program = keep(device().create_program(
        {.label = "mesh",
         .vertex = "#version 450 core\nlayout(location = 0) in vec3 position;\n"
                   "void main() { gl_Position = vec4(position, 1.0); }\n",
         .fragment =
             "#version 450 core\nlayout(location = 0) out vec4 result;\nvoid main() { result = vec4(1.0); }\n"}));
    const auto draw = [&] {
        gl::CommandList list;
        list.add(clearing(target));
        list.add(gl::SetPipeline{{.program = program}});
        list.add(gl::BindMeshes{vertices, indices, fixed_buffer<std::uint32_t>({0, 0})});
        list.add(gl::DrawMeshes{0, 6, 0, 0, 1});
        list.add(gl::EndPass{});
        run(list);
    };
    draw();
    EXPECT_THAT(pixels(), Each(Rgba{255, 255, 255, 255}));
    gl::CommandList update;
    update.update<std::uint32_t>(indices, 12, std::vector<std::uint32_t>{0, 0, 0});
    run(update);
    draw();
    EXPECT_EQ(at(pixels(), 15, 1), (Rgba{255, 255, 255, 255}));
    EXPECT_EQ(at(pixels(), 1, 15), (Rgba{0, 0, 0, 0})) << "the second triangle is gone";
    device().destroy(vertices);
    device().destroy(indices);
    EXPECT_EQ(glIsBuffer(names[0]), GL_TRUE);
    EXPECT_EQ(glIsBuffer(names[1]), GL_TRUE);
    glDeleteBuffers(2, names);
}

TEST_F(DeviceImports, BuffersThatCannotServeAreRefused) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    EXPECT_FALSE(gl::import_buffer(device(), name, {.size = 64, .use = gl::BufferUse::fixed})) << "without storage";
    glNamedBufferStorage(name, 64, nullptr, 0);
    for (const gl::BufferDesc& wrong : {gl::BufferDesc{.size = 65, .use = gl::BufferUse::fixed},
                                        gl::BufferDesc{.size = 0, .use = gl::BufferUse::fixed},
                                        gl::BufferDesc{.size = 64, .use = gl::BufferUse::updated},
                                        gl::BufferDesc{.size = 64, .use = gl::BufferUse::read_back},
                                        gl::BufferDesc{.size = 24, .use = gl::BufferUse::fixed, .texels = true}})
        EXPECT_FALSE(gl::import_buffer(device(), name, wrong)) << wrong.size;
    EXPECT_FALSE(gl::import_buffer(device(), 4711, {.size = 64, .use = gl::BufferUse::fixed}));
    EXPECT_EQ(gl::live_objects(device()), 3u) << "colour, depth and target of the fixture";
    const gl::BufferHandle right =
        gl::import_buffer(device(), name, {.label = "texels", .size = 32, .use = gl::BufferUse::fixed, .texels = true});
    ASSERT_TRUE(right);
    const GLuint texels = gl::gl_texels_name(device(), right);
    GLint size = 0;
    glGetTextureLevelParameteriv(texels, 0, GL_TEXTURE_BUFFER_SIZE, &size);
    EXPECT_EQ(size, 32) << "what lies behind the described part is not read";
    device().destroy(right);
    EXPECT_EQ(glIsTexture(texels), GL_FALSE);
    glDeleteBuffers(1, &name);
}

}  // namespace
}  // namespace gnomon
