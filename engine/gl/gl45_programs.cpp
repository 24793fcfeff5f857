#include <algorithm>
#include <array>
#include <utility>

#include "engine/gl/gl45_objects.h"

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

}  // namespace

Made<GlProgram> make_program(const ProgramDesc& desc) {
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
        return {{}, Failure::compile_failed, desc.label + " (" + sources[i].name + "): " + stage.log};
    }
    const GLuint program = glCreateProgram();
    for (const GLuint stage : stages)
        if (stage != 0) glAttachShader(program, stage);
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
        return {{program, {}}};
    }
    std::string log = desc.label + " (link): " + link_log(program);
    glDeleteProgram(program);
    const bool driver = error == Failure::out_of_memory || error == Failure::context_lost;
    return {{}, driver ? error : Failure::link_failed, std::move(log)};
}

}  // namespace gnomon::gl
