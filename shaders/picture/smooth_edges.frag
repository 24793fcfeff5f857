// Smooths stair-steps of a finished picture, as FXAA does (T. Lottes 2009): a step of an edge is found by its contrast
// and followed to both ends. The line between the ends cuts a share off each pixel, which takes the colour beyond it
// (A. Reshetov 2009, "Morphological Antialiasing"). A pixel apart from all around it is part of something thinner than
// a pixel, and takes their mean. Contrast is judged as eyes do, colours are mixed as light.
#include "common/bindings.glsl"
layout(binding = kFinishedPictureUnit) uniform sampler2D picture;
layout(location = 0) out vec4 colour_out;

const float kLeastContrast = 1.0 / 32.0;     // share of white: less is no visible step
const float kRelativeContrast = 1.0 / 8.0;   // share of the brightest pixel around
const float kEndShare = 0.25;                // share of the step's contrast by which its end differs from the step
const int kFarthest_px = 16;                 // a step is followed so far to either side

vec4 colour_at(ivec2 pixel) { return texelFetch(picture, clamp(pixel, ivec2(0), textureSize(picture, 0) - 1), 0); }

// Returns brightness as eyes see it, over white where the picture is transparent. The root stands for the display's
// curve.
float brightness(vec4 colour) { return sqrt(dot(colour.rgb + (1.0 - colour.a), vec3(0.2126, 0.7152, 0.0722))); }   // Rec. 709
float brightness_at(ivec2 pixel) { return brightness(colour_at(pixel)); }

// One end of a step.
struct StepEnd {
    float distance_px;   // from the pixel's middle
    float change;        // change of the mean of both sides there
};

StepEnd follow(ivec2 pixel, ivec2 side, ivec2 along, float mean, float contrast) {
    float change = 0.0;
    int i = 1;
    for (; i <= kFarthest_px; ++i) {
        ivec2 at = pixel + along * i;
        change = 0.5 * (brightness_at(at) + brightness_at(at + side)) - mean;
        if (abs(change) >= kEndShare * contrast) break;
    }
    return StepEnd(float(i) - 0.5, change);
}

// Returns the share of the pixel that lies beyond the edge between it and its neighbour at `side`.
float share_beyond(ivec2 pixel, ivec2 side, float own, float beyond) {
    ivec2 along = abs(side.yx);
    float mean = 0.5 * (own + beyond), contrast = abs(beyond - own);
    StepEnd first = follow(pixel, side, -along, mean, contrast), second = follow(pixel, side, along, mean, contrast);
    StepEnd nearest = first;
    if (second.distance_px < first.distance_px) nearest = second;
    // There the edge turns into this row of pixels, or away from it.
    bool cuts_this_row = (nearest.change < 0.0) != (own < mean);
    return cuts_this_row ? 0.5 - nearest.distance_px / (first.distance_px + second.distance_px) : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 colours[9];   // from the lower left on, row by row
    float b[9];
    for (int i = 0; i < 9; ++i) colours[i] = colour_at(pixel + ivec2(i % 3 - 1, i / 3 - 1));
    for (int i = 0; i < 9; ++i) b[i] = brightness(colours[i]);
    float left = b[3], own = b[4], right = b[5], down = b[1], up = b[7];
    colour_out = colours[4];
    float most = max(own, max(max(up, down), max(left, right)));
    float contrast = most - min(own, min(min(up, down), min(left, right)));
    if (contrast < max(kLeastContrast, kRelativeContrast * most)) return;

    float bends_up = abs(b[0] + b[6] - 2.0 * left) + 2.0 * abs(up + down - 2.0 * own) + abs(b[2] + b[8] - 2.0 * right);
    float bends_aside = abs(b[0] + b[2] - 2.0 * down) + 2.0 * abs(left + right - 2.0 * own) + abs(b[6] + b[8] - 2.0 * up);
    bool level = bends_up >= bends_aside;   // the edge is nearer to level than to upright
    float before = level ? down : left, behind = level ? up : right;
    ivec2 across = level ? ivec2(0, 1) : ivec2(1, 0);
    bool is_behind = abs(behind - own) >= abs(before - own);
    ivec2 side = is_behind ? across : -across;
    float share = share_beyond(pixel, side, own, is_behind ? behind : before);
    vec4 smoothed = mix(colours[4], colour_at(pixel + side), share);

    vec4 corners = colours[0] + colours[2] + colours[6] + colours[8], beside = colours[1] + colours[3] + colours[5] + colours[7];
    float around = (2.0 * (up + down + left + right) + b[0] + b[2] + b[6] + b[8]) / 12.0;
    float apart = min(abs(around - own) / contrast, 1.0);
    colour_out = mix(smoothed, (4.0 * colours[4] + 2.0 * beside + corners) / 16.0, apart);
}
