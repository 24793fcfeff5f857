#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "systems/extract/extract.h"
#include "systems/extract/scene_tree.h"
#include "tests/system/test_world.h"

namespace gnomon {

/// World with a snapshot that is taken as a frame does it.
class ExtractedWorldTest : public ::testing::Test {
protected:
    void update() {
        const TransformReport& report = transforms.update(world.registry);
        extractor.update(world.registry, library, report, viewport_px, snapshot);
    }
    /// Compares the snapshot with that of a fresh extractor.
    void expect_as_if_made_anew(const std::string& what) {
        TransformSystem fresh_transforms;
        Extractor fresh_extractor;
        SceneSnapshot fresh;
        fresh_extractor.update(world.registry, library, fresh_transforms.update(world.registry), viewport_px, fresh);
        EXPECT_EQ(snapshot.consumers, fresh.consumers) << what;
        ASSERT_EQ(snapshot.lights.size(), fresh.lights.size()) << what;
        for (std::size_t i = 0; i < fresh.lights.size(); ++i) {
            LightItem now = snapshot.lights[i];
            const LightItem& then = fresh.lights[i];
            EXPECT_EQ(now.name, then.name) << what;
            EXPECT_TRUE(now.entity == then.entity && now.kind == then.kind && now.position_ws_m == then.position_ws_m &&
                        now.rotation_ws == then.rotation_ws && now.colour == then.colour &&
                        now.intensity == then.intensity && now.range_m == then.range_m &&
                        now.inner_cone_rad == then.inner_cone_rad && now.outer_cone_rad == then.outer_cone_rad &&
                        now.source_radius_m == then.source_radius_m && now.sun_radius_rad == then.sun_radius_rad &&
                        now.has_shadow == then.has_shadow && now.shadow == then.shadow && now.tuning == then.tuning)
                << what << ": " << now.name;
        }
        ASSERT_EQ(snapshot.instances.size(), fresh.instances.size()) << what;
        for (std::size_t i = 0; i < fresh.instances.size(); ++i) {
            const InstanceItem &now = snapshot.instances[i], &then = fresh.instances[i];
            EXPECT_TRUE(now.entity == then.entity && now.mesh == then.mesh && now.basis == then.basis &&
                        now.translation_ws_m == then.translation_ws_m && now.casts == then.casts &&
                        now.receives == then.receives && now.cast_layers == then.cast_layers &&
                        now.receive_layers == then.receive_layers && now.visible == then.visible &&
                        now.shadow_catcher == then.shadow_catcher)
                << what << ": instance " << i;
        }
        ASSERT_EQ(snapshot.dropped.size(), fresh.dropped.size()) << what;
        for (std::size_t i = 0; i < fresh.dropped.size(); ++i) {
            EXPECT_EQ(snapshot.dropped[i].entity, fresh.dropped[i].entity) << what;
            EXPECT_EQ(snapshot.dropped[i].name, fresh.dropped[i].name) << what;
            EXPECT_EQ(snapshot.dropped[i].reason, fresh.dropped[i].reason) << what;
        }
        EXPECT_TRUE(has_tree(snapshot)) << what;
    }
    std::vector<std::uint64_t> instance_versions() const {
        std::vector<std::uint64_t> versions;
        for (const InstanceItem& item : snapshot.instances) versions.push_back(item.version);
        return versions;
    }
    TestWorld world;
    assets::MeshLibrary library = test_library();
    TransformSystem transforms;
    Extractor extractor;
    SceneSnapshot snapshot;
    glm::uvec2 viewport_px{640, 360};
};

}  // namespace gnomon
