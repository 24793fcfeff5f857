// Nine nearest taps on the texel grid, equal weights.
float shadow_filter(ShadowPoint point) {
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) sum += shadow_tap(point, vec2(x, y));
    return sum * (1.0 / 9.0);
}
