// The direction in which a path leaves its pixel. After lib/receiver.glsl.
//
// TARN_SAMPLE_UNIFORM, TARN_SAMPLE_COSINE: over the hemisphere of the shading normal; else in proportion to the BRDF.

vec3 sample_first_direction(Receiver r, vec3 u) {
#if defined(TARN_SAMPLE_UNIFORM)
    return sample_uniform_hemisphere(u.yz);
#elif defined(TARN_SAMPLE_COSINE)
    return sample_cosine_hemisphere(u.yz);
#else
    return sample_brdf(r.point.material, r.brdf, u);
#endif
}

// Density of `local`, solid angle; 0 below the shading normal.
float first_direction_pdf(Receiver r, vec3 local) {
#if defined(TARN_SAMPLE_UNIFORM)
    return local.z > 0.0f ? 0.5f * INV_PI : 0.0f;
#elif defined(TARN_SAMPLE_COSINE)
    return max(local.z, 0.0f) * INV_PI;
#else
    return pdf_brdf_solid_angle(r.point.material, r.brdf, local);
#endif
}

// A ray that leaves the surface; inactive for directions that carry nothing.
RayRecord leave_surface(ShadingPoint point, vec3 direction, float pdf, uint pixel) {
    RayRecord ray = inactive_ray();
    if (!(pdf > 0.0f) || dot(point.geometric_normal, direction) <= 0.0f) return ray;
    ray.origin = offset_ray_origin(point.position, point.position_error, point.geometric_normal, direction);
    ray.direction = direction;
    ray.max_t = RAY_INFINITY;
    ray.pixel = pixel;
    return ray;
}
