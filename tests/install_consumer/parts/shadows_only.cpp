// Linked against Gnomon::shadows alone. With an argument it would draw, in a context of the engine's own.
#include <gnomon/entt.h>
#include <gnomon/shadows.h>
#include <gnomon/version.h>

#include <cstdio>

int main(int argc, char**) {
    if (argc > 1) {
        const auto shadows = gnomon::Shadows::create({.lookup = gnomon::LookupOptions{}});
        return shadows && shadows.value()->lookup_glsl() ? 0 : 1;
    }
    const gnomon::Version version = gnomon::linked_version();
    std::printf("Gnomon %d.%d.%d\n", version.major, version.minor, version.patch);
    return version == gnomon::kVersion ? 0 : 1;
}
