// Poisson disk of 32 points, progressive: the first n are one, too. Each next point is the one of the lattice of 1/64
// in the unit disk that lies farthest from those before. Where that is less, it lies 0.3 beyond its own image in the
// rim (farthest-point sampling, Eldar et al. 1997). tests/unit/shadow/shaders/poisson_disk_test.cpp computes them
// again.
const vec2 kDisk[32] = {
    vec2(0.5, 0.25), vec2(-0.515625, -0.265625), vec2(-0.328125, 0.609375), vec2(0.3125, -0.625),
    vec2(0.25, 0.796875), vec2(-0.8125, 0.25), vec2(0.796875, -0.265625), vec2(-0.25, -0.8125),
    vec2(-0.0625, 0.09375), vec2(-0.078125, -0.390625), vec2(0.328125, -0.171875), vec2(0.921875, 0.15625),
    vec2(0.65625, 0.65625), vec2(-0.65625, -0.671875), vec2(-0.921875, -0.15625), vec2(-0.71875, 0.625),
    vec2(0.703125, -0.640625), vec2(-0.421875, 0.234375), vec2(-0.125, 0.9375), vec2(0.03125, 0.46875),
    vec2(0.109375, -0.953125), vec2(-0.5, 0.859375), vec2(-0.359375, -0.53125), vec2(0.421875, -0.90625),
    vec2(-0.875, -0.453125), vec2(0.359375, 0.515625), vec2(0.609375, -0.03125), vec2(-0.625, 0.015625),
    vec2(0.515625, -0.40625), vec2(0.875, 0.453125), vec2(0.015625, -0.671875), vec2(0.234375, 0.109375)
};
