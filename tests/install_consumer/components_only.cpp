#include <gnomon/components.h>
#include <gnomon/light.h>
#include <gnomon/shadow_tuning.h>

int main() {
    const gnomon::LightShadow shadow;
    const gnomon::Transform transform;
    const gnomon::ShadowTuning tuning;
    return shadow.enabled && tuning.reuse.economy && transform.parent == gnomon::ecs::kNull ? 0 : 1;
}
