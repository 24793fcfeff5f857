#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "sample_game/support/built_in_scenes/courtyard/courtyard.h"
#include "sample_game/support/files/image_files.h"

namespace {

constexpr int kBadInput = 2;

int run(int argc, char** argv) {
    std::string file;
    std::vector<double> offset_m;
    gnomon::game::CourtyardOptions options;
    bool no_casters = false;
    CLI::App app("Writes Gnomon's built-in scene as a GLB file");
    app.add_option("file", file, "the file to write")->required();
    app.add_option("--offset", offset_m, "X,Y,Z: where the courtyard's origin lies, metres")
        ->delimiter(',')
        ->expected(3);
    app.add_option("--scale", options.scale, "size, 1 is life size");
    app.add_flag("--no-casters", no_casters, "no mesh casts a shadow");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kBadInput;
    }
    if (!offset_m.empty()) options.offset_m = {offset_m[0], offset_m[1], offset_m[2]};
    options.casters = !no_casters;
    const glm::dvec3& o = options.offset_m;
    if (!(std::isfinite(o.x + o.y + o.z) && std::isfinite(options.scale) && options.scale > 0.0)) {
        std::cerr << "gnomon_scene_generator: offset and scale must be finite, the scale above 0\n";
        return kBadInput;
    }
    const gnomon::game::Courtyard courtyard = gnomon::game::make_courtyard(options);
    if (const auto error = gnomon::game::write_file(file, courtyard.glb)) {
        std::cerr << "gnomon_scene_generator: " << gnomon::to_line(*error) << "\n";
        return kBadInput;
    }
    std::cout << courtyard.triangles << " triangles, " << courtyard.glb.size() << " bytes\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon_scene_generator: %s\n", error.what());
        return kBadInput;
    }
}
