// Whether two pixels are alike enough for one to use the other's samples. It looks at surfaces alone, never at the
// samples, and so adds no bias by itself.

// Depth of a point before a camera, metres.
float view_depth(CameraRecord camera, vec3 position) { return dot(position - camera.position, camera.forward); }

// `expected` is where the neighbour's surface should lie, `plane_*` the neighbour's own surface. The distance from the
// plane is relative to the depth, and not along the view: a floor seen at a grazing angle stays one surface.
bool is_similar(vec3 expected, vec3 normal, float alpha, vec3 plane_position, vec3 plane_normal, float plane_alpha,
                float depth) {
    const float MAX_PLANE_DISTANCE = 0.1f;  // of the depth
    const float MIN_NORMAL_COSINE = 0.5f;
    const float MAX_ALPHA_DIFFERENCE = 0.25f;
    bool near = abs(dot(expected - plane_position, plane_normal)) <= MAX_PLANE_DISTANCE * abs(depth);
    return near && dot(normal, plane_normal) >= MIN_NORMAL_COSINE && abs(alpha - plane_alpha) <= MAX_ALPHA_DIFFERENCE;
}
