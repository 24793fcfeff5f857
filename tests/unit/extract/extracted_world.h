#pragma once
#include <gtest/gtest.h>

#include "systems/extract/extract.h"
#include "systems/extract/scene_tree.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// A world whose snapshot is taken as a frame does it.
class ExtractedWorldTest : public ::testing::Test {
protected:
    void update() {
        const TransformReport& report = transforms.update(world.registry);
        extractor.update(world.registry, library, report, viewport_px, snapshot);
    }
    TestWorld world;
    assets::MeshLibrary library = test_library();
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    glm::uvec2 viewport_px{640, 360};
};

}  // namespace gnomon
