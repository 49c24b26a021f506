// Blue noise for a pixel. One text for shaders and the CPU; see scene/surface.h. After math/blue_noise.h.
//
// Also needs, where it is included:
//     uint fetch_blue_noise(uint index) (a texel of the mask, by blue_noise_texel's index)

// Two numbers in [0, 1), uniform over seeds; blue over pixels and frames, each alone and both together.
// `pixel` is its column and row, `dimension` one of math/random.h's: two decisions must not share one.
FN vec2 blue_noise2(uvec2 pixel, uint frame, uint seed, uint dimension) {
    BlueNoiseShift shift = blue_noise_shift(frame, seed, dimension);
    return shift_blue_noise(shift, fetch_blue_noise(blue_noise_texel(shift, pixel, frame)));
}

// One such number: the first of the two, which is the bluer one.
FN float blue_noise1(uvec2 pixel, uint frame, uint seed, uint dimension) {
    return blue_noise2(pixel, frame, seed, dimension).x;
}
