#pragma once
#include <cstdint>

namespace gnomon {

/// A way in which OpenGL can fail. Each strikes calls of its own: allocations and draws, completeness checks, compile
/// and link status, mappings, and the query whether the context is lost.
enum class GlFault : std::uint8_t {
    out_of_memory,
    invalid_value,
    incomplete_target,
    compile_failed,
    link_failed,
    null_map,
    context_lost
};
const char* to_text(GlFault fault);

/// Stands between the executor and the driver while it lives, in the loader's table of functions. Fails chosen calls,
/// and counts OpenGL's objects. One at a time; everything that is to fail must have been called before, since the table
/// is filled by first calls.
class FailingGl {
public:
    FailingGl();
    ~FailingGl();
    FailingGl(const FailingGl&) = delete;
    FailingGl& operator=(const FailingGl&) = delete;

    /// Restarts the counts. The `call`th call (from 0) that `fault` can strike fails, and if `lasting` all later ones,
    /// until end(). A lost context stays lost until the next begin().
    void begin(GlFault fault, std::uint64_t call, bool lasting);
    void end();

    std::uint64_t calls(GlFault fault) const;  // since begin() that it could have struck
    std::int64_t live_names() const;           // objects made less objects deleted, of every kind
};

}  // namespace gnomon
