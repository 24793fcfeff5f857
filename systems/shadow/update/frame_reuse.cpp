#include "systems/shadow/update/frame_reuse.h"

namespace gnomon::shadow {
namespace {

/// Stores `now`. Returns whether it was the same.
template <class T>
bool keep(T& last, const T& now) {
    if (last == now) return true;
    last = now;
    return false;
}

}  // namespace

bool FrameReuse::unchanged(const SceneSnapshot& scene, const ShadowSettings& settings) {
    bool same = keep(version_, scene.version) && scene.version != 0;
    same &= keep(shadows_, settings.shadows);
    same &= keep(rays_, settings.rays);
    same &= keep(budget_, settings.budget);
    same &= keep(consumers_, scene.consumers);
    same &= keep(pictures_, scene.pictures);
    same &= keep(sampled_depths_, settings.feedback.sampled_depths);
    same &= keep(exposure_, settings.feedback.exposure);
    return same;
}

}  // namespace gnomon::shadow
