#include <cstdlib>

// Loaded before the game. At the GNOMON_LOSE_AT-th query whether the context still lives, the driver answers no.
// The loader of OpenGL's functions keeps them in exported variables; this is one of them.
namespace {

unsigned answer() {
    constexpr unsigned kNoError = 0, kGuiltyContextReset = 0x8253;
    static long asked = 0;
    const char* when = std::getenv("GNOMON_LOSE_AT");
    return when != nullptr && ++asked == std::atol(when) ? kGuiltyContextReset : kNoError;
}

}  // namespace

extern unsigned (*epoxy_glGetGraphicsResetStatus)();
unsigned (*epoxy_glGetGraphicsResetStatus)() = answer;
