#include "systems/shadow/update/frame_reuse.h"

#include "engine/core/put.h"

namespace gnomon::shadow {
bool FrameReuse::unchanged(const SceneSnapshot& scene, const ShadowSettings& settings) {
    bool same = !put(version_, scene.version) && scene.version != 0;
    same &= !put(shadows_, settings.shadows);
    same &= !put(rays_, settings.rays);
    same &= !put(budget_, settings.budget);
    same &= !put(consumers_, scene.consumers);
    same &= !put(pictures_, scene.pictures);
    same &= !put(sampled_depths_, settings.feedback.sampled_depths);
    same &= !put(exposure_, settings.feedback.exposure);
    return same;
}

}  // namespace gnomon::shadow
