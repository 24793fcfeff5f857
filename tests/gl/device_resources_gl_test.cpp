#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "systems/extract/gpu_scene.h"
#include "tests/gl/device_fixture.h"

namespace gnomon {
namespace {

using gl::Failure;
using gl::Format;
using gl::TextureKind;
using ::testing::ContainsRegex;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

using DeviceResources = DeviceTest;

TEST_F(DeviceResources, InfoNamesTheRendererAndItsLimits) {
    // A request for a 4.5 core context may yield any later version.
    EXPECT_THAT(device().info().name, ::testing::AnyOf(HasSubstr("OpenGL 4.5"), HasSubstr("OpenGL 4.6")));
    EXPECT_GE(device().info().max_texture_px, 4096u);
    EXPECT_GE(device().info().max_layers, 2048u) << "guaranteed by OpenGL";
    EXPECT_GE(device().info().max_texel_bytes, 65536u * gl::kTexelBytes) << "guaranteed by OpenGL";
    constexpr std::uint64_t kMillions = 2000000;
    if (device().info().is_software) {
        EXPECT_GE(device().info().max_texel_bytes, kMillions * sizeof(InstanceRecord));
    }
    EXPECT_GT(device().info().uniform_alignment, 0u);
    EXPECT_EQ(device().info().is_software, device().info().name.find("llvmpipe") != std::string::npos);
}

struct FormatRow {
    const char* name;
    Format format;
    TextureKind kind;
};
class DeviceFormat : public GlTest, public ::testing::WithParamInterface<FormatRow> {};

/// Makes bytes that every format can hold exactly: depth as fractions of 2^16 - 1, other formats as small values.
std::vector<std::byte> pattern(Format format, std::size_t texels) {
    std::vector<std::byte> bytes;
    const auto add = [&](auto value) {
        const auto* first = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), first, first + sizeof value);
    };
    std::size_t channels = 4;
    for (const Format two : {Format::rg16, Format::rg16f, Format::rg32f, Format::rg32ui})
        if (format == two) channels = 2;
    if (format == Format::r8 || format == Format::r16f || format == Format::r32f || format == Format::r32ui ||
        gl::is_depth(format))
        channels = 1;
    for (std::size_t i = 0; i < texels * channels; ++i) {
        const auto small = static_cast<std::uint16_t>(i % 251);
        switch (format) {
            case Format::r8:
            case Format::rgba8:
            case Format::srgb8_a8:
                add(static_cast<std::uint8_t>(small));
                break;
            case Format::rgba16_snorm:
                add(static_cast<std::int16_t>(small * 130 - 16000));
                break;
            case Format::rg16:
            case Format::rgba16:
                add(static_cast<std::uint16_t>(small * 260));
                break;
            case Format::r16f:
            case Format::rg16f:
            case Format::rgba16f:
                add(static_cast<std::uint16_t>(0x3c00 + small));
                break;  // half floats from 1
            case Format::r32f:
            case Format::rg32f:
            case Format::rgba32f:
                add(static_cast<float>(i) * -1.25f);
                break;
            case Format::r32ui:
            case Format::rg32ui:
            case Format::rgba32ui:
                add(0xffffffffu - static_cast<std::uint32_t>(i));
                break;
            case Format::d16:
            case Format::d24:
            case Format::d32f:
            case Format::d24_s8:
            case Format::d32f_s8:
                add(static_cast<float>(small) / 255.0f);
                break;
        }
    }
    return bytes;
}

TEST_P(DeviceFormat, EveryLayerSurvivesUploadAndReadback) {
    const auto [name, format, kind] = GetParam();
    const gl::TextureDesc desc{.label = name,
                               .kind = kind,
                               .format = format,
                               .width = 8,
                               .height = 8,
                               .layers = kind == TextureKind::array ? 3u : 1u};
    const std::uint32_t layers = gl::layer_count(desc);
    const std::vector<std::byte> sent = pattern(format, 8 * 8 * layers);
    const gl::TextureHandle texture = keep(device().create_texture(desc, sent));
    const std::size_t layer_bytes = sent.size() / layers;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        const std::span<const std::byte> wanted = std::span{sent}.subspan(layer * layer_bytes, layer_bytes);
        if (gl::is_depth(format)) {
            const bool is_24 = format == Format::d24 || format == Format::d24_s8;
            const double half_step = format == Format::d16 ? 0.5 / 65535.0 : is_24 ? 0.5 / 16777215.0 : 0;
            const std::vector<float> back = read<float>(texture, 64, layer);
            for (std::size_t i = 0; i < back.size(); ++i) {
                float value = 0;
                std::memcpy(&value, wanted.data() + i * sizeof value, sizeof value);
                ASSERT_NEAR(back[i], value, half_step + 6e-8) << name << " layer " << layer;  // + a float's rounding
            }
        } else {
            const std::vector<std::byte> back = read<std::byte>(texture, layer_bytes, layer);
            ASSERT_TRUE(std::equal(back.begin(), back.end(), wanted.begin())) << name << " layer " << layer;
        }
    }
}

TEST_P(DeviceFormat, EveryLayerIsCopiedAloneAndAsItIs) {
    const auto [name, format, kind] = GetParam();
    const gl::TextureDesc desc{.label = name,
                               .kind = kind,
                               .format = format,
                               .width = 8,
                               .height = 8,
                               .layers = kind == TextureKind::array ? 3u : 1u};
    const std::uint32_t layers = gl::layer_count(desc);
    const std::size_t layer_bytes = std::size_t{64} * gl::transfer_bytes(format);
    const std::vector<std::byte> sent = pattern(format, 8 * 8 * layers), nothing(sent.size());
    const gl::TextureHandle from = keep(device().create_texture(desc, sent));
    const gl::TextureHandle to = keep(device().create_texture(desc, nothing));
    const auto bytes_of = [&](gl::TextureHandle texture, std::uint32_t layer) {
        return read<std::byte>(texture, layer_bytes, layer);
    };
    const std::vector<std::byte> blank = bytes_of(to, 0);
    for (std::uint32_t copied = 0; copied < layers; ++copied) {
        gl::CommandList list;
        list.add(gl::CopyTexture{from, to, copied});
        run(list);
        for (std::uint32_t layer = 0; layer < layers; ++layer)
            EXPECT_EQ(bytes_of(to, layer), layer <= copied ? bytes_of(from, layer) : blank)
                << name << " layer " << layer;
    }
    for (const gl::CopyTexture& beyond : {gl::CopyTexture{from, to, layers}, {from, to, 0, {5, 0, 4, 8}}}) {
        gl::CommandList list;
        list.add(beyond);
        EXPECT_EQ(device().submit(list).failure, gl::Failure::invalid_value);
    }
}

TEST_P(DeviceFormat, AnAreaIsCopiedAndNothingElse) {
    constexpr std::uint32_t kSide = 8;
    const auto [name, format, kind] = GetParam();
    const gl::TextureDesc desc{.label = name, .kind = kind, .format = format, .width = kSide, .height = kSide};
    const std::size_t texel = gl::transfer_bytes(format), layer_bytes = kSide * kSide * texel;
    const std::vector<std::byte> sent = pattern(format, kSide * kSide * gl::layer_count(desc)), nothing(sent.size());
    const gl::TextureHandle from = keep(device().create_texture(desc, sent));
    const gl::TextureHandle to = keep(device().create_texture(desc, nothing));
    const std::vector<std::byte> source = read<std::byte>(from, layer_bytes), blank = read<std::byte>(to, layer_bytes);
    const gl::Rect area{2, 1, 5, 3};
    gl::CommandList list;
    list.add(gl::CopyTexture{from, to, 0, area});
    run(list);
    const std::vector<std::byte> copied = read<std::byte>(to, layer_bytes);
    for (std::uint32_t at = 0; at < kSide * kSide; ++at) {
        const auto x = static_cast<std::int32_t>(at % kSide), y = static_cast<std::int32_t>(at / kSide);
        const bool in = x >= area.x && x < area.x + area.width && y >= area.y && y < area.y + area.height;
        const auto first = (in ? source : blank).begin() + static_cast<std::ptrdiff_t>(at * texel);
        ASSERT_TRUE(std::equal(first, first + static_cast<std::ptrdiff_t>(texel),
                               copied.begin() + static_cast<std::ptrdiff_t>(at * texel)))
            << name << " " << x << ", " << y;
    }
}

TEST_P(DeviceFormat, EveryLayerCanBeDrawnIntoAlone) {
    const char* name = GetParam().name;
    const Format format = GetParam().format;
    const TextureKind kind = GetParam().kind;
    const gl::TextureDesc desc{.label = name,
                               .kind = kind,
                               .format = format,
                               .width = 4,
                               .height = 4,
                               .layers = kind == TextureKind::array ? 3u : 1u};
    const gl::TextureHandle texture = keep(device().create_texture(desc, {}));
    const std::uint32_t layers = gl::layer_count(desc);
    const std::size_t bytes = std::size_t{16} * gl::transfer_bytes(format);
    const auto clear_layer = [&](std::uint32_t layer, float value) {
        const gl::Attachment attachment{texture, kind == TextureKind::flat ? -1 : static_cast<std::int32_t>(layer)};
        gl::TargetDesc into{.label = name};
        if (gl::is_depth(format))
            into.depth = attachment;
        else
            into.colours = {attachment};
        const gl::TargetHandle target = keep(device().create_target(into));
        gl::CommandList list;
        list.add(gl::BeginPass{.target = target,
                               .viewport = {0, 0, 4, 4},
                               .clear_depth = true,
                               .depth = value,
                               .clear_colour = true,
                               .colour = {value, value, value, value}});
        list.add(gl::EndPass{});
        run(list);
    };
    for (std::uint32_t layer = 0; layer < layers; ++layer) clear_layer(layer, 0.0f);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        clear_layer(layer, 1.0f);
        for (std::uint32_t other = 0; other < layers; ++other) {
            const std::vector<std::byte> back = read<std::byte>(texture, bytes, other);
            const bool zero = std::all_of(back.begin(), back.end(), [](std::byte b) { return b == std::byte{0}; });
            ASSERT_EQ(zero, other > layer) << name << ": layer " << other << " after clearing " << layer;
        }
    }
}

constexpr std::array kFormatNames = {std::pair{"r8", Format::r8},
                                     std::pair{"rgba8", Format::rgba8},
                                     std::pair{"srgb8_a8", Format::srgb8_a8},
                                     std::pair{"rgba16_snorm", Format::rgba16_snorm},
                                     std::pair{"rg16", Format::rg16},
                                     std::pair{"rgba16", Format::rgba16},
                                     std::pair{"r16f", Format::r16f},
                                     std::pair{"rg16f", Format::rg16f},
                                     std::pair{"rgba16f", Format::rgba16f},
                                     std::pair{"rgba32f", Format::rgba32f},
                                     std::pair{"r32f", Format::r32f},
                                     std::pair{"rg32f", Format::rg32f},
                                     std::pair{"r32ui", Format::r32ui},
                                     std::pair{"rg32ui", Format::rg32ui},
                                     std::pair{"d16", Format::d16},
                                     std::pair{"d24", Format::d24},
                                     std::pair{"d32f", Format::d32f},
                                     std::pair{"d24_s8", Format::d24_s8},
                                     std::pair{"d32f_s8", Format::d32f_s8}};

std::vector<FormatRow> format_rows() {
    std::vector<FormatRow> rows;
    for (const auto& [name, format] : kFormatNames) {
        for (const TextureKind kind : {TextureKind::flat, TextureKind::array, TextureKind::cube}) {
            rows.push_back({name, format, kind});
        }
    }
    return rows;
}
std::string row_name(const ::testing::TestParamInfo<FormatRow>& row) {
    const char* kinds[] = {"flat", "array", "cube"};
    return std::string{row.param.name} + "_" + kinds[static_cast<std::size_t>(row.param.kind)];
}
INSTANTIATE_TEST_SUITE_P(All, DeviceFormat, ::testing::ValuesIn(format_rows()), row_name);

TEST_F(DeviceResources, DescriptionsOverTheLimitsLeaveNothing) {
    const std::size_t live = gl::live_objects(device());
    const std::uint32_t over = device().info().max_texture_px + 1;
    EXPECT_EQ(device().create_texture({.width = over}, {}).failure, Failure::invalid_value);
    EXPECT_EQ(device().create_texture({.width = 0}, {}).failure, Failure::invalid_value);
    EXPECT_EQ(device().create_texture({.kind = TextureKind::cube, .width = 4, .height = 8}, {}).failure,
              Failure::invalid_value);
    EXPECT_EQ(device().create_buffer({.size = 0}, {}).failure, Failure::invalid_value);
    EXPECT_EQ(gl::live_objects(device()), live);
}

TEST_F(DeviceResources, AMapThatDoesNotFitInMemoryIsAFailureAndTheNextOneFits) {
    if (!device().info().is_software) GTEST_SKIP() << "the size that cannot be had is known for llvmpipe only";
    const std::uint32_t px = device().info().max_cube_px;
    const auto huge = device().create_texture(
        {.label = "huge", .kind = TextureKind::cube, .format = Format::d32f, .width = px, .height = px}, {});
    EXPECT_EQ(huge.failure, Failure::out_of_memory);
    EXPECT_THAT(huge.log, HasSubstr("huge"));
    take_messages();  // the driver may report what it could not do
    EXPECT_TRUE(
        keep(device().create_texture({.label = "small", .format = Format::d32f, .width = 64, .height = 64}, {})));
}

TEST_F(DeviceResources, IncompleteTargetsAreRefused) {
    const std::size_t live = gl::live_objects(device());
    EXPECT_EQ(device().create_target({.label = "colour as depth", .depth = {colour}}).failure,
              Failure::incomplete_target);
    EXPECT_EQ(device().create_target({.label = "depth as colour", .colours = {{depth}}}).failure,
              Failure::incomplete_target);
    EXPECT_EQ(device().create_target({.label = "nothing"}).failure, Failure::incomplete_target);
    EXPECT_EQ(device().create_target({.label = "no layer", .depth = {depth, 1}}).failure, Failure::incomplete_target);
    EXPECT_EQ(device().create_target({.label = "dead", .depth = {{999}}}).failure, Failure::invalid_value);
    EXPECT_EQ(gl::live_objects(device()), live);
    take_messages();  // Mesa reports why each target is incomplete
}

TEST_F(DeviceResources, AShaderThatDoesNotCompileSaysWhereAndLeavesNothing) {
    const std::size_t live = gl::live_objects(device());
    const std::uint64_t compiled = device().compiled_programs();
    const std::string good = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    const std::string bad = "#version 450 core\n#line 7 3\nnonsense;\nvoid main() {}\n";
    const auto fragment = device().create_program({"bad fragment", good, bad});
    EXPECT_EQ(fragment.failure, Failure::compile_failed);
    EXPECT_THAT(fragment.log, ContainsRegex(R"(bad fragment .fragment.: .*3[:(]7)"));
    const auto vertex = device().create_program({"bad vertex", bad, good});
    EXPECT_EQ(vertex.failure, Failure::compile_failed);
    EXPECT_THAT(vertex.log, HasSubstr("(vertex)"));
    EXPECT_EQ(gl::live_objects(device()), live);
    EXPECT_EQ(device().compiled_programs(), compiled + 2) << "failures count";
    take_messages();
}

TEST_F(DeviceResources, StagesThatDoNotFitDoNotLink) {
    const auto program = device().create_program(
        {"unfit", "#version 450 core\nout vec2 a;\nvoid main() { gl_Position = vec4(0.0); a = vec2(0.0); }\n",
         "#version 450 core\nin vec4 a;\nout vec4 c;\nvoid main() { c = a; }\n"});
    EXPECT_EQ(program.failure, Failure::link_failed);
    EXPECT_THAT(program.log, HasSubstr("unfit (link): "));
    EXPECT_THAT(program.log, Not(::testing::EndsWith("(link): ")));
    take_messages();
}

TEST_F(DeviceResources, DestroyingFreesAndAnUnknownHandleDoesNothing) {
    const std::size_t live = gl::live_objects(device());
    const auto buffer = device().create_buffer({.label = "b", .size = 16}, {});
    const auto sampler = device().create_sampler({.label = "s"});
    EXPECT_EQ(gl::live_objects(device()), live + 2);
    device().destroy(buffer.handle);
    device().destroy(buffer.handle);
    device().destroy(gl::SamplerHandle{});
    device().destroy(sampler.handle);
    EXPECT_EQ(gl::live_objects(device()), live);
}

TEST_F(DeviceResources, ReadingTheWrongAmountFails) {
    std::vector<std::byte> out(kTexels * 4 - 1);
    EXPECT_FALSE(device().read_texture(colour, 0, out));
    out.push_back({});
    EXPECT_TRUE(device().read_texture(colour, 0, out));
    EXPECT_FALSE(device().read_texture(colour, 1, out));
    EXPECT_FALSE(device().read_texture({999}, 0, out));
}

TEST_F(DeviceResources, MipsAreMadeFromTheUploadedLevel) {
    std::vector<std::byte> checker;
    for (std::size_t i = 0; i < 16; ++i)
        checker.insert(checker.end(), 1, (i + i / 4) % 2 == 0 ? std::byte{255} : std::byte{0});
    const auto texture = keep(device().create_texture(
        {.label = "checker", .format = Format::r8, .width = 4, .height = 4, .mips = 0}, checker));
    const auto program =
        full_screen("result = vec4(textureLod(map, vec2(0.5), 2.0).r);", "layout(binding = 0) uniform sampler2D map;");
    const auto sampler = keep(device().create_sampler({.label = "mips", .mipmaps = true}));
    gl::CommandList list;
    list.add(clearing(target));
    list.add(gl::SetPipeline{{.program = program}});
    list.add(gl::BindTexture{0, texture, sampler});
    list.add(gl::DrawTriangle{});
    list.add(gl::EndPass{});
    run(list);
    EXPECT_NEAR(at(pixels(), 8, 8)[0], 128, 1);
}

TEST_F(DeviceResources, LongLabelsAreCut) {
    const std::string label(100000, 'x');
    keep(device().create_texture({.label = label}, {}));
    gl::CommandList list;
    list.add(gl::BeginGroup{label});
    list.add(gl::EndGroup{});
    run(list);
}

TEST_F(DeviceResources, ADeviceDeletesWhatItsUserLeft) {
    auto second = gl::make_gl45_device({});
    ASSERT_TRUE(second);
    EXPECT_EQ(gl::live_objects(*second.value()), 0u);
    EXPECT_TRUE(second.value()->create_texture({.label = "left alive on purpose"}, {}));
    EXPECT_EQ(gl::live_objects(*second.value()), 1u);
}

}  // namespace
}  // namespace gnomon
