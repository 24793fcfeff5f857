#include "components/light.h"
#include "components/shadow_tuning.h"
#include "components/transform.h"

int main() {
    const gnomon::LightShadow shadow;
    const gnomon::Transform transform;
    const gnomon::ShadowTuning tuning;
    return shadow.enabled && tuning.reuse.economy && transform.parent == gnomon::ecs::kNull ? 0 : 1;
}
