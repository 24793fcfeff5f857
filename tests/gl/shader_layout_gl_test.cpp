#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

#include "engine/rays/mesh_bvh.h"
#include "systems/debug/depth_tiles.h"
#include "systems/debug/shown_scale.h"
#include "systems/extract/gpu_scene.h"
#include "systems/lighting/lighting_system.h"
#include "systems/shadow/exact/occluder_pyramid_pass.h"
#include "systems/visibility/ray_records.h"
#include "tests/gl/gl_test_context.h"
#include "tests/gl/program_sources.h"

// Compares the layout that the linker reports for each block with the C++ struct that provides the block's bytes.
namespace gnomon {
namespace {

struct Member {
    std::string name;
    std::size_t offset;
};
struct Block {
    GLenum interface;  // GL_UNIFORM_BLOCK or GL_SHADER_STORAGE_BLOCK
    std::string name;
    GLint binding;
    std::size_t size;  // bytes of the struct, or of one element of a storage block
    std::vector<Member> members;
};

std::vector<Member> view_members() {
    using shadow::LightRecord;
    using shadow::ViewRecord;
    std::vector<Member> members;
    for (std::size_t i = 0; i < shadow::kMaxViews; ++i) {
        const std::string view = "LightBlock.views[" + std::to_string(i) + "].";
        const std::size_t at = offsetof(LightRecord, views) + i * sizeof(ViewRecord);
        members.push_back({view + "map_from_anchor", at + offsetof(ViewRecord, map_from_anchor)});
        members.push_back({view + "axis_u", at + offsetof(ViewRecord, axis_u)});
        members.push_back({view + "axis_v", at + offsetof(ViewRecord, axis_v)});
        members.push_back({view + "axis_back", at + offsetof(ViewRecord, axis_back)});
        members.push_back({view + "numeric", at + offsetof(ViewRecord, numeric)});
        members.push_back({view + "anchor_from_camera", at + offsetof(ViewRecord, anchor_from_camera)});
    }
    return members;
}

Block light_block() {
    using shadow::LightRecord;
    Block block{GL_UNIFORM_BLOCK,
                "LightBlock",
                1,
                sizeof(LightRecord),
                {{"LightBlock.position", offsetof(LightRecord, position)},
                 {"LightBlock.to_light", offsetof(LightRecord, to_light)},
                 {"LightBlock.radiance", offsetof(LightRecord, radiance)},
                 {"LightBlock.cone", offsetof(LightRecord, cone)},
                 {"LightBlock.options", offsetof(LightRecord, options)},
                 {"LightBlock.bias", offsetof(LightRecord, bias)},
                 {"LightBlock.filtering", offsetof(LightRecord, filtering)},
                 {"LightBlock.spread", offsetof(LightRecord, spread)},
                 {"LightBlock.seed_cell", offsetof(LightRecord, seed_cell)},
                 {"LightBlock.seed_place", offsetof(LightRecord, seed_place)},
                 {"LightBlock.moments", offsetof(LightRecord, moments)},
                 {"LightBlock.moment_sampling", offsetof(LightRecord, moment_sampling)},
                 {"LightBlock.low", offsetof(LightRecord, low)}}};
    for (Member& m : view_members()) block.members.push_back(std::move(m));
    return block;
}

Block depth_tiles_block() {
    using debug::DepthTile;
    using debug::DepthTiles;
    Block block{GL_UNIFORM_BLOCK, "DepthTiles", 0, sizeof(DepthTiles), {{"options", offsetof(DepthTiles, options)}}};
    for (std::size_t i = 0; i < debug::kMaxTiles; ++i) {
        const std::string tile = "tiles[" + std::to_string(i) + "].";
        const std::size_t at = offsetof(DepthTiles, tiles) + i * sizeof(DepthTile);
        block.members.push_back({tile + "place", at + offsetof(DepthTile, place)});
        block.members.push_back({tile + "depth", at + offsetof(DepthTile, depth)});
        block.members.push_back({tile + "right", at + offsetof(DepthTile, right)});
        block.members.push_back({tile + "up", at + offsetof(DepthTile, up)});
        block.members.push_back({tile + "forward", at + offsetof(DepthTile, forward)});
    }
    return block;
}

std::vector<Block> expected_blocks() {
    using lighting::AmbientRecord;
    using lighting::ExposureRecord;
    using rays::BvhNode;
    using rays::BvhTriangle;
    using shadow::CameraRecord;
    using shadow::DepthViewRecord;
    using shadow::PyramidRecord;
    using shadow::MomentRecord;
    using visibility::RayInstance;
    using visibility::RayTop;
    return {
        light_block(),
        depth_tiles_block(),
        {GL_UNIFORM_BLOCK,
         "CameraBlock",
         0,
         sizeof(CameraRecord),
         {{"CameraBlock.clip_from_anchor", offsetof(CameraRecord, clip_from_anchor)},
          {"CameraBlock.anchor_high", offsetof(CameraRecord, anchor_high)},
          {"CameraBlock.anchor_low", offsetof(CameraRecord, anchor_low)},
          {"CameraBlock.right", offsetof(CameraRecord, right)},
          {"CameraBlock.up", offsetof(CameraRecord, up)},
          {"CameraBlock.back", offsetof(CameraRecord, back)},
          {"CameraBlock.unproject", offsetof(CameraRecord, unproject)}}},
        {GL_UNIFORM_BLOCK,
         "DepthViewBlock",
         0,
         sizeof(DepthViewRecord),
         {{"DepthViewBlock.clip_from_anchor", offsetof(DepthViewRecord, clip_from_anchor)},
          {"DepthViewBlock.anchor_high", offsetof(DepthViewRecord, anchor_high)},
          {"DepthViewBlock.anchor_low", offsetof(DepthViewRecord, anchor_low)}}},
        {GL_UNIFORM_BLOCK,
         "MomentBlock",
         0,
         sizeof(MomentRecord),
         {{"MomentBlock.settings", offsetof(MomentRecord, settings)},
          {"MomentBlock.range", offsetof(MomentRecord, range)},
          {"MomentBlock.place", offsetof(MomentRecord, place)},
          {"MomentBlock.axis_u", offsetof(MomentRecord, axis_u)},
          {"MomentBlock.axis_v", offsetof(MomentRecord, axis_v)},
          {"MomentBlock.axis_back", offsetof(MomentRecord, axis_back)},
          {"MomentBlock.weights[0]", offsetof(MomentRecord, weights)}}},
        {GL_UNIFORM_BLOCK,
         "EndsBlock",
         0,
         sizeof(PyramidRecord),
         {{"EndsBlock.axis_u", offsetof(PyramidRecord, axis_u)},
          {"EndsBlock.axis_v", offsetof(PyramidRecord, axis_v)},
          {"EndsBlock.axis_back", offsetof(PyramidRecord, axis_back)},
          {"EndsBlock.from", offsetof(PyramidRecord, from)},
          {"EndsBlock.to", offsetof(PyramidRecord, to)},
          {"EndsBlock.numbers", offsetof(PyramidRecord, numbers)}}},
        {GL_UNIFORM_BLOCK,
         "MaterialBlock",
         2,
         sizeof(MaterialRecord),
         {{"MaterialBlock.base_colour", offsetof(MaterialRecord, base_colour)},
          {"MaterialBlock.emissive", offsetof(MaterialRecord, emissive)},
          {"MaterialBlock.metallic", offsetof(MaterialRecord, metallic)},
          {"MaterialBlock.roughness", offsetof(MaterialRecord, roughness)},
          {"MaterialBlock.alpha_cutoff", offsetof(MaterialRecord, alpha_cutoff)},
          {"MaterialBlock.has_texture", offsetof(MaterialRecord, has_texture)}}},
        {GL_UNIFORM_BLOCK,
         "AmbientBlock",
         3,
         sizeof(AmbientRecord),
         {{"AmbientBlock.sky", offsetof(AmbientRecord, sky_lux)},
          {"AmbientBlock.ground", offsetof(AmbientRecord, ground_lux)}}},
        {GL_UNIFORM_BLOCK,
         "FogBlock",
         2,
         sizeof(lighting::FogRecord),
         {{"FogBlock.to_box[0]", offsetof(lighting::FogRecord, to_box)},
          {"FogBlock.taken", offsetof(lighting::FogRecord, taken)},
          {"FogBlock.marks", offsetof(lighting::FogRecord, marks)}}},
        {GL_UNIFORM_BLOCK,
         "ShownScale",
         5,
         sizeof(debug::ShownScale),
         {{"ShownScale.colours", offsetof(debug::ShownScale, colours)},
          {"ShownScale.options", offsetof(debug::ShownScale, options)}}},
        {GL_UNIFORM_BLOCK, "ExposureBlock", 4, sizeof(ExposureRecord), {{"exposure", offsetof(ExposureRecord, scale)}}},
        {GL_SHADER_STORAGE_BLOCK,
         "RayListBuffer",
         1,
         sizeof(std::uint32_t),
         {{"ray_count", 0}, {"listed_pixels[0]", sizeof(std::uint32_t)}}},
        {GL_SHADER_STORAGE_BLOCK, "SheetEndBuffer", 2, shadow::pyramid_bytes(1, 1), {{"sheet_ends[0]", 0}}},
        {GL_SHADER_STORAGE_BLOCK, "RayMaskBuffer", 7, sizeof(std::uint32_t), {{"ray_masks[0]", 0}}},
        {GL_SHADER_STORAGE_BLOCK, "AreaTable", 4, sizeof(glm::vec4), {{"area_lobes[0]", 0}}},
        {GL_SHADER_STORAGE_BLOCK,
         "LineBuffer",
         0,
         sizeof(debug::LineVertex),
         {{"line_vertices[0].position_ca", offsetof(debug::LineVertex, position_ca_m)},
          {"line_vertices[0].colour", offsetof(debug::LineVertex, colour)}}},
        {GL_SHADER_STORAGE_BLOCK, "DepthBinBuffer", 0, sizeof(SampledDepths::pixels[0]), {{"depth_bins[0]", 0}}},
        {GL_SHADER_STORAGE_BLOCK, "ExposureBuffer", 0, sizeof(float), {{"exposures[0]", 0}}},
    };
}

/// Program that is compiled apart from the device, since a device's interface gives no GL names.
class LinkedProgram {
public:
    explicit LinkedProgram(const gl::ProgramDesc& desc) : name_(glCreateProgram()) {
        attach(GL_VERTEX_SHADER, desc.vertex);
        attach(GL_GEOMETRY_SHADER, desc.geometry);
        attach(GL_FRAGMENT_SHADER, desc.fragment);
        attach(GL_COMPUTE_SHADER, desc.compute);
        glLinkProgram(name_);
        GLint linked = 0;
        glGetProgramiv(name_, GL_LINK_STATUS, &linked);
        linked_ = linked != 0;
    }
    ~LinkedProgram() { glDeleteProgram(name_); }
    LinkedProgram(const LinkedProgram&) = delete;
    LinkedProgram& operator=(const LinkedProgram&) = delete;
    bool linked() const { return linked_; }

    /// Returns a property of a resource; empty if the program has no such resource.
    std::optional<GLint> property(GLenum interface, const std::string& resource, GLenum what) const {
        const GLuint index = glGetProgramResourceIndex(name_, interface, resource.c_str());
        if (index == GL_INVALID_INDEX) return std::nullopt;
        GLint value = -1;
        glGetProgramResourceiv(name_, interface, index, 1, &what, 1, nullptr, &value);
        return value;
    }
    std::vector<std::string> blocks(GLenum interface) const {
        GLint count = 0;
        glGetProgramInterfaceiv(name_, interface, GL_ACTIVE_RESOURCES, &count);
        std::vector<std::string> names;
        for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
            char text[256] = {};
            glGetProgramResourceName(name_, interface, i, sizeof text, nullptr, text);
            names.emplace_back(text);
        }
        return names;
    }

private:
    void attach(GLenum stage, const std::string& source) {
        if (source.empty()) return;
        const GLuint shader = glCreateShader(stage);
        const char* text = source.c_str();
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(name_, shader);
        glDeleteShader(shader);
    }
    GLuint name_;
    bool linked_ = false;
};

void expect_block(const LinkedProgram& program, const Block& block) {
    const bool uniform = block.interface == GL_UNIFORM_BLOCK;
    EXPECT_EQ(program.property(block.interface, block.name, GL_BUFFER_BINDING), block.binding);
    if (uniform) {
        EXPECT_EQ(program.property(block.interface, block.name, GL_BUFFER_DATA_SIZE), static_cast<GLint>(block.size));
    }
    const GLenum variables = uniform ? GL_UNIFORM : GL_BUFFER_VARIABLE;
    for (const Member& member : block.members) {
        EXPECT_EQ(program.property(variables, member.name, GL_OFFSET), static_cast<GLint>(member.offset))
            << member.name;
        if (uniform || member.name.find('[') == std::string::npos) continue;
        // An array of vectors has a stride itself, an array of structs has one through its members.
        const GLenum stride = member.name.back() == ']' ? GL_ARRAY_STRIDE : GL_TOP_LEVEL_ARRAY_STRIDE;
        EXPECT_EQ(program.property(variables, member.name, stride), static_cast<GLint>(block.size)) << member.name;
    }
}

class ShaderLayout : public GlTest {};

TEST_F(ShaderLayout, EveryProgramLinksAndItsBlocksLieAsTheirStructsDo) {
    const std::vector<Block> blocks = expected_blocks();
    const std::string past_views = "LightBlock.views[" + std::to_string(shadow::kMaxViews) + "].axis_u";
    std::map<std::string, int> seen;
    for (const gl::ProgramDesc& desc : all_programs()) {
        SCOPED_TRACE(desc.label);
        const LinkedProgram program(desc);
        ASSERT_TRUE(program.linked());
        for (const GLenum interface : {GL_UNIFORM_BLOCK, GL_SHADER_STORAGE_BLOCK}) {
            for (const std::string& name : program.blocks(static_cast<GLenum>(interface))) {
                const auto found =
                    std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.name == name; });
                ASSERT_NE(found, blocks.end()) << "no struct is known for " << name;
                expect_block(program, *found);
                ++seen[name];
            }
        }
        EXPECT_FALSE(program.property(GL_UNIFORM, past_views, GL_OFFSET)) << "more views than the struct has";
    }
    for (const Block& block : blocks) EXPECT_GT(seen[block.name], 0) << block.name << " was in no program";
}

TEST_F(ShaderLayout, AMemberTooManyIsNoticed) {
    const auto programs = all_programs();
    auto desc =
        *std::find_if(programs.begin(), programs.end(), [](const gl::ProgramDesc& d) { return d.label == "surface"; });
    for (std::string* source : {&desc.vertex, &desc.fragment}) {
        const auto at = source->find("vec4 anchor_high;");
        ASSERT_NE(at, std::string::npos);
        source->insert(at, "vec4 stranger; ");
    }
    const LinkedProgram program(desc);
    ASSERT_TRUE(program.linked());
    EXPECT_EQ(program.property(GL_UNIFORM, "CameraBlock.anchor_low", GL_OFFSET),
              static_cast<GLint>(offsetof(shadow::CameraRecord, anchor_low) + sizeof(glm::vec4)));
    EXPECT_EQ(program.property(GL_UNIFORM_BLOCK, "CameraBlock", GL_BUFFER_DATA_SIZE),
              static_cast<GLint>(sizeof(shadow::CameraRecord) + sizeof(glm::vec4)));
}

}  // namespace
}  // namespace gnomon
