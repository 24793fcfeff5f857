// Size of a pixel's area on a map. Requires shadow/filters/area_spread.glsl.

// Returns the radius of the pixel's area on the map, texels: that of a disk with the same variance.
float area_radius_texel(ShadowPoint point) {
    PixelArea area = pixel_area(point.position_ca, point.normal);
    vec2 right = texels_moved(point, area.right), up = texels_moved(point, area.up);
    return sqrt((dot(right, right) + dot(up, up)) / 6.0);
}
