#pragma once
#include <vector>

#include "components/camera.h"
#include "components/transform.h"
#include "engine/assets/scene_data.h"
#include "engine/math/aabb.h"

namespace gnomon::game {

struct FramedCamera {
    Transform transform;
    Camera camera;
};

/// A camera for a scene without one. `bounds` empty: the origin, looking along -Z.
///
/// From outside: a three-quarter view from the +x, +y, +z side, the whole box in a 16:9 picture.
/// From inside, if the scene is an interior: the box's centre is surrounded by faces turned toward it, in all
/// horizontal directions and upward where the outside camera would stand. The camera then stands at eye height in the
/// free space along the longest horizontal axis and looks through the centre to the other end.
FramedCamera frame_scene(const assets::SceneData& scene, const std::vector<WorldTransform>& poses,
                         const math::Aabb& bounds);

}  // namespace gnomon::game
