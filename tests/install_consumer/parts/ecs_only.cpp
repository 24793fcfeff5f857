// Linked against Gnomon::ecs alone, as shadows_only.cpp.
#include <gnomon/assets.h>
#include <gnomon/frame.h>
#include <gnomon/registry.h>

#include <cstdio>

int main(int argc, char**) {
    gnomon::assets::MeshLibrary library;
    gnomon::ecs::Registry world;
    world.emplace<gnomon::Light>(world.create());
    if (argc > 1) {
        const auto frame = gnomon::Frame::create(library);
        if (frame) frame.value()->run(world, {.debug = {.view = gnomon::debug::find_view("depth")}});
        return frame ? 0 : 1;
    }
    std::printf("%zu entity\n", world.alive_count());
    return 0;
}
