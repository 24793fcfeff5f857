// Two shares of 1 that differ from point to point without a pattern: by the pixel, or by the cell of the world.
// light.seed_cell: xyz: the camera's cell; w: round. light.seed_place: xyz: its place in that cell, cells; w: cells per metre.
// The lattice's axes are those of systems/shadow/publish/noise_cell.cpp, and wrap after 2^24 cells as there.
const vec3 kSeedAxisX = vec3(-0.6666666667, 0.1333333333, 0.7333333333);
const vec3 kSeedAxisY = vec3(0.6666666667, -0.3333333333, 0.6666666667);
const vec3 kSeedAxisZ = vec3(0.3333333333, 0.9333333333, 0.1333333333);
const float kSeedCells = 16777216.0;

// Returns a number with every bit dependent on every bit of x (multiply and xor-shift).
uint scrambled(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

uint wrapped_cell(int camera_cell, float along) {
    float cell = floor(along);
    return (uint(camera_cell) + uint(int(cell - kSeedCells * floor(cell / kSeedCells)))) & 0xffffffu;
}

// Step of both shares from round to round: rounds fill the square evenly (R2 sequence, Roberts 2018). Round 0 has none.
const vec2 kRoundStep = vec2(0.7548776662, 0.5698402910);

vec2 shares_of(uint seed) {
    vec2 shares = vec2(float(seed & 0xffffu), float(seed >> 16)) / 65536.0;
    return fract(shares + kRoundStep * float(light.seed_cell.w));
}

vec2 cell_seed(vec3 position_ca) {
    vec3 along = vec3(dot(kSeedAxisX, position_ca), dot(kSeedAxisY, position_ca), dot(kSeedAxisZ, position_ca));
    along = along * light.seed_place.w + light.seed_place.xyz;
    uint seed = scrambled(wrapped_cell(light.seed_cell.x, along.x));
    seed = scrambled(seed ^ wrapped_cell(light.seed_cell.y, along.y));
    return shares_of(scrambled(seed ^ wrapped_cell(light.seed_cell.z, along.z)));
}

vec2 shadow_seed(ShadowPoint point) {
    if (light.filtering.w != 0) return cell_seed(point.position_ca);
    return shares_of(scrambled(scrambled(uint(int(gl_FragCoord.x))) ^ uint(int(gl_FragCoord.y))));
}
