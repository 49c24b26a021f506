// Whether two pixels are alike enough for one to use the other's samples. It looks at surfaces alone, never at the
// samples, and so adds no bias by itself.

// Depth of a point before a camera, metres.
float view_depth(CameraRecord camera, vec3 position) {
    return dot(position - camera.position, camera.forward);
}

// What the test knows of a surface.
struct Look {
    vec3 position;
    vec3 geometric_normal;
    vec3 shading_normal;
    float alpha;  // GGX
};

// `expected` is where the neighbour's surface should lie, `found` the neighbour's own. The distance from the plane is
// relative to the depth, and not along the view: a floor seen at a grazing angle stays one surface. The plane is that of
// the geometry: a normal map does not tilt it.
bool is_similar(Look expected, Look found, float depth) {
    const float MAX_PLANE_DISTANCE = 0.1f;  // of the depth
    const float MIN_NORMAL_COSINE = 0.5f;
    const float MAX_ALPHA_DIFFERENCE = 0.25f;
    bool near = abs(dot(expected.position - found.position, found.geometric_normal)) <=
                MAX_PLANE_DISTANCE * abs(depth);
    return near && dot(expected.shading_normal, found.shading_normal) >= MIN_NORMAL_COSINE &&
           abs(expected.alpha - found.alpha) <= MAX_ALPHA_DIFFERENCE;
}

// Whether either surface is nearly a mirror: its lobe is narrower than the angle between the directions to a light from
// one pixel and from the next. Then a neighbour can draw this pixel's sample, but almost never does.
bool is_mirror_like(Look a, Look b) {
    const float MAX_MIRROR_ALPHA = 0.01f;  // a roughness of 0.1
    return min(a.alpha, b.alpha) <= MAX_MIRROR_ALPHA;
}

Look look_of(ShadingPoint point) {
    return Look(point.position, point.geometric_normal, point.shading_normal, point.material.alpha);
}

// Out of the rows that the G-buffer keeps; see lib/gbuffer.glsl.
Look look_of_layers(vec4 position, vec4 normals, vec4 diffuse) {
    return Look(position.xyz, decode_octahedral(normals.xy), decode_octahedral(normals.zw), diffuse.w);
}
