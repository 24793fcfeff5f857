// First verdict that is a place in the list of pixels for rays. Verdicts below are
// shadow/filters/exact/classify.glsl's.
const uint kListed = 2u;

// Block of pixels in which the rays of a list are drawn. Rays that lie together in it go in step, be it eight or more
// at a time. The picture is about as wide as it is high, since a quad's two triangles both draw what lies along its
// diagonal. C++ twin: systems/lighting/ray_list.cpp.
const ivec2 kListBlock = ivec2(4, 2);
const int kInBlock = kListBlock.x * kListBlock.y;

// Returns the width of the list's picture, a power of two, for as many places as the other picture has pixels.
int list_width(ivec2 picture) { return max(1 << (findMSB(picture.x * picture.y) + 1) / 2, kListBlock.x); }

int list_rows(int places, int width) {
    int in_rows = width * kListBlock.y;
    return (places + in_rows - 1) / in_rows * kListBlock.y;
}

int list_place(ivec2 texel, int width) {
    ivec2 block = texel / kListBlock, inside = texel % kListBlock;
    return (block.y * (width / kListBlock.x) + block.x) * kInBlock + inside.y * kListBlock.x + inside.x;
}

// Returns the texel of a place. Software devices divide whole numbers one by one. This division has no remainder, which
// floats would round.
ivec2 list_texel(int place, int width) {
    int block = place / kInBlock, inside = place % kInBlock, across = width / kListBlock.x, x = block & across - 1;
    int y = int(float(block - x) / float(across));
    return ivec2(x, y) * kListBlock + ivec2(inside % kListBlock.x, inside / kListBlock.x);
}
