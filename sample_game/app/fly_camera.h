#pragma once
#include "gnomon/components.h"
#include "gnomon/registry.h"
#include "gnomon/window.h"

namespace gnomon::game {

/// WASD, Q and E, Shift and the mouse. The scene's own camera is in charge until the first key or movement;
/// then a free one starts from where it was.
class FlyCamera {
public:
    /// Takes the speed of walking; Shift is faster.
    explicit FlyCamera(double speed_m_per_s) : speed_m_per_s_(speed_m_per_s) {}

    /// Moves the camera by one frame's input. `look`: the mouse turns the head. Before the first frame was run there is
    /// no place to start from, and nothing moves.
    void update(const Input& input, bool look, double dt_s, ecs::Registry& registry);

private:
    bool take_over(ecs::Registry& registry);

    double speed_m_per_s_;
    ecs::Entity entity_ = ecs::kNull;
    glm::dvec3 position_ws_m_{0.0};
    double yaw_rad_ = 0.0, pitch_rad_ = 0.0;
};

}  // namespace gnomon::game
