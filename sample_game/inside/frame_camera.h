#pragma once
#include <vector>

#include "gnomon/assets.h"
#include "gnomon/box.h"
#include "gnomon/components.h"

namespace gnomon::game {

struct FramedCamera {
    Transform transform;
    Camera camera;
};

/// Places a camera for a scene without one. `bounds` empty: the origin, looking along -Z.
///
/// From outside: a three-quarter view from the +x, +y, +z side, the whole box in a 16:9 picture.
/// From inside, if the scene is an interior: at eye height in the free space along the longest horizontal axis. It
/// looks through the centre to the other end. In an interior, faces turned toward the box's centre surround it in all
/// horizontal directions, and upward where the outside camera would stand.
FramedCamera frame_scene(const assets::SceneData& scene, const std::vector<WorldTransform>& poses,
                         const math::Aabb& bounds);

}  // namespace gnomon::game
