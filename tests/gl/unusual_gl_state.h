#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Work of an engine at the time when it calls Gnomon.
/// - feedback: its own program with transform feedback and queries running, messages going to its callback
/// - pipeline: separable programs, messages going to the log
enum class EngineWork { feedback, pipeline };

/// Sets every piece of the current context's state to a legal value that is not its default, with objects of its own.
class UnusualGlState {
public:
    explicit UnusualGlState(EngineWork work);
    ~UnusualGlState();
    UnusualGlState(const UnusualGlState&) = delete;
    UnusualGlState& operator=(const UnusualGlState&) = delete;

    /// Returns the messages that the engine's callback received, of at least medium severity.
    const std::vector<std::string>& complaints() const { return complaints_; }

    /// Returns whether the state of this work leaves a piece at its default, by the beginning of the piece's name.
    static bool is_default(EngineWork work, std::string_view name);

private:
    void set_modes();
    void set_transfer();
    void set_indexed();
    void bind_textures();
    void bind_buffers();
    void bind_vertices();
    void bind_framebuffers();
    void use_programs();
    void run_queries();
    unsigned buffer();
    unsigned texture(unsigned target);

    EngineWork work_;
    std::vector<unsigned> buffers_, textures_, samplers_, queries_, programs_, framebuffers_;
    unsigned vertex_array_ = 0, renderbuffer_ = 0, pipeline_ = 0, feedback_ = 0;
    std::vector<std::string> complaints_;
};

}  // namespace gnomon
