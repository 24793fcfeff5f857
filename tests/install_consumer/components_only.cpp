#include "components/light.h"
#include "components/light_shadow.h"
#include "components/transform.h"

int main() {
    const gnomon::LightShadow shadow;
    const gnomon::Transform transform;
    return shadow.enabled && transform.parent == gnomon::ecs::kNull ? 0 : 1;
}
