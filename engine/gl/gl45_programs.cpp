#include "engine/gl/gl45_programs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace gnomon::gl {
namespace {

struct Stage {
    GLuint name = 0;
    std::string log;
};

Stage compile(GLenum kind, const std::string& source) {
    Stage stage;
    const GLuint shader = glCreateShader(kind);
    const char* text = source.c_str();
    const auto length = static_cast<GLint>(source.size());
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    GLint compiled = GL_FALSE, log_length = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) {
        stage.name = shader;
        return stage;
    }
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &log_length);
    stage.log.resize(static_cast<std::size_t>(std::max(log_length, 1)));
    glGetShaderInfoLog(shader, static_cast<GLsizei>(stage.log.size()), nullptr, stage.log.data());
    stage.log.pop_back();  // the terminating zero
    glDeleteShader(shader);
    return stage;
}

std::string link_log(GLuint program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    log.pop_back();
    return log;
}

/// Links a program. `retrievable`: its binary will be read.
Made<GLuint> link(const ProgramDesc& desc, bool retrievable) {
    drop_gl_errors();
    struct Source {
        GLenum kind;
        const char* name;
        const std::string& text;
    };
    const std::array<Source, 4> sources = {{{GL_COMPUTE_SHADER, "compute", desc.compute},
                                            {GL_VERTEX_SHADER, "vertex", desc.vertex},
                                            {GL_GEOMETRY_SHADER, "geometry", desc.geometry},
                                            {GL_FRAGMENT_SHADER, "fragment", desc.fragment}}};
    std::array<GLuint, sources.size()> stages{};
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const bool needed = desc.compute.empty() && sources[i].kind == GL_VERTEX_SHADER;
        if (sources[i].text.empty() && !needed) continue;
        const Stage stage = compile(sources[i].kind, sources[i].text);
        stages[i] = stage.name;
        if (stage.name != 0) continue;
        for (const GLuint made : stages) glDeleteShader(made);
        return {0, Failure::compile_failed, desc.label + " (" + sources[i].name + "): " + stage.log};
    }
    const GLuint program = glCreateProgram();
    for (const GLuint stage : stages)
        if (stage != 0) glAttachShader(program, stage);
    if (retrievable) glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program);
    for (const GLuint stage : stages) {
        if (stage == 0) continue;
        glDetachShader(program, stage);
        glDeleteShader(stage);
    }
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    const Failure error = take_gl_error();
    if (linked == GL_TRUE && error == Failure::none) {
        set_gl_label(GL_PROGRAM, program, desc.label);
        return {program};
    }
    std::string log = desc.label + " (link): " + link_log(program);
    glDeleteProgram(program);
    const bool driver = error == Failure::out_of_memory || error == Failure::context_lost;
    return {0, driver ? error : Failure::link_failed, std::move(log)};
}

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? std::string{} : reinterpret_cast<const char*>(text);
}

/// Returns what binaries depend on besides the sources.
std::string driver_identity() {
    std::string text;
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION, GL_SHADING_LANGUAGE_VERSION})
        text += text_of(name) + '\n';
    return text;
}

std::vector<GLint> binary_formats() {
    GLint count = 0;
    glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    std::vector<GLint> formats(static_cast<std::size_t>(std::max(count, 0)));
    if (!formats.empty()) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
    return formats;
}

}  // namespace

GlPrograms::GlPrograms(std::filesystem::path cache_folder)
    : formats_(binary_formats()),
      cache_(formats_.empty() ? std::filesystem::path{} : std::move(cache_folder), driver_identity()) {}

/// Loads a program from the cache. Returns 0 if there is none that the driver accepts; a rejected one is deleted.
GLuint GlPrograms::from_cache(const ProgramDesc& desc) const {
    const std::optional<ProgramCache::Binary> found = cache_.find(desc);
    if (!found) return 0;
    const bool known = std::find(formats_.begin(), formats_.end(), static_cast<GLint>(found->format)) != formats_.end();
    const bool fits = found->bytes.size() <= static_cast<std::size_t>(std::numeric_limits<GLsizei>::max());
    drop_gl_errors();
    const GLuint program = known && fits ? glCreateProgram() : 0;
    GLint linked = GL_FALSE;
    if (program != 0) {
        glProgramBinary(program, found->format, found->bytes.data(), static_cast<GLsizei>(found->bytes.size()));
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
    }
    if (program != 0 && linked == GL_TRUE && take_gl_error() == Failure::none) {
        set_gl_label(GL_PROGRAM, program, desc.label);
        return program;
    }
    drop_gl_errors();
    glDeleteProgram(program);
    cache_.forget(desc);
    return 0;
}

void GlPrograms::keep(const ProgramDesc& desc, GLuint program) const {
    GLint length = 0;
    glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length > 0) {
        ProgramCache::Binary binary;
        binary.bytes.resize(static_cast<std::size_t>(length));
        GLsizei written = 0;
        GLenum format = GL_NONE;
        glGetProgramBinary(program, length, &written, &format, binary.bytes.data());
        binary.format = format;
        binary.bytes.resize(static_cast<std::size_t>(std::clamp(written, 0, length)));
        if (take_gl_error() == Failure::none) cache_.keep(desc, binary);
    }
    drop_gl_errors();
}

Made<GLuint> GlPrograms::make(const ProgramDesc& desc) {
    if (const GLuint kept = from_cache(desc); kept != 0) {
        ++counts_.cached;
        return {kept};
    }
    ++counts_.compiled;
    Made<GLuint> made = link(desc, cache_.is_on());
    if (made.failure == Failure::none && cache_.is_on()) keep(desc, made.object);
    return made;
}

}  // namespace gnomon::gl
