// The scene at a hit: from (instance, primitive, barycentrics) to a surface, one text for shaders and for the
// CPU.
//
// Not a header of its own right: it is included where these functions exist, which fetch from texture buffers
// in GLSL (lib/scene_buffers.glsl) and from vectors in C++, where it forms the body of a class
// (world/scene_access.h):
//     uvec4 fetch_vertex_row(uint), uvec3 fetch_triangle(uint), uvec4 fetch_instance_row(uint),
//     uvec4 fetch_material_row(uint), vec4 fetch_texel(uint)
// and the constants SCENE_HAS_TEXTURES, SCENE_HAS_NORMAL_MAPS: what the scene lacks is compiled out, because
// a software GPU runs both sides of a branch.

FN InstanceRecord load_instance(uint instance) {
    uint row = instance * INSTANCE_ROWS;
    return unpack_instance(fetch_instance_row(row), fetch_instance_row(row + 1u),
                           fetch_instance_row(row + 2u), fetch_instance_row(row + 3u));
}

FN MaterialRecord load_material(uint material) {
    uint row = material * MATERIAL_ROWS;
    return unpack_material(fetch_material_row(row), fetch_material_row(row + 1u),
                           fetch_material_row(row + 2u), fetch_material_row(row + 3u));
}

FN SlotRecord load_slot(uint material, uint slot) {
    uint row = material * MATERIAL_ROWS + 4u + slot * 2u;
    return unpack_slot(fetch_material_row(row), fetch_material_row(row + 1u));
}

FN vec3 transform_point(InstanceRecord i, vec3 p) {
    vec4 h = vec4(p, 1.0f);
    return vec3(dot(i.world_from_object[0], h), dot(i.world_from_object[1], h),
                dot(i.world_from_object[2], h));
}

FN vec3 transform_vector(InstanceRecord i, vec3 v) {
    return vec3(dot(vec3(i.world_from_object[0]), v), dot(vec3(i.world_from_object[1]), v),
                dot(vec3(i.world_from_object[2]), v));
}

// Normals go with the cofactor matrix, which is the inverse transpose up to a positive scale once the sign of
// a mirroring transform is taken out.
FN vec3 transform_normal(InstanceRecord i, vec3 n) {
    vec3 x = vec3(i.world_from_object[0]);
    vec3 y = vec3(i.world_from_object[1]);
    vec3 z = vec3(i.world_from_object[2]);
    vec3 result = vec3(dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n));
    return (i.flags & INSTANCE_MIRRORED) != 0u ? -result : result;
}

// ---- Textures
// -----------------------------------------------------------------------------------------------------

// KHR_texture_transform: translation * rotation * scale.
FN vec2 slot_uv(SlotRecord slot, vec2 uv0, vec2 uv1) {
    vec2 uv = (slot.flags & SLOT_SECOND_UV) != 0u ? uv1 : uv0;
    uv = uv * slot.scale;
    if (slot.rotation_rad != 0.0f) {
        float c = cos(slot.rotation_rad);
        float s = sin(slot.rotation_rad);
        uv = vec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x);
    }
    return uv + slot.offset;
}

// Value of a texture slot, linear; 1 where there is no texture.
FN vec4 sample_slot(SlotRecord slot, vec2 uv0, vec2 uv1) {
    if (!SCENE_HAS_TEXTURES || (slot.flags & SLOT_PRESENT) == 0u) return vec4(1.0f);
    ivec2 size = ivec2(int(slot.size & 0xffffu), int(slot.size >> 16u));
    TexelFootprint f = texel_footprint(slot_uv(slot, uv0, uv1), size, slot.flags & 3u,
                                       (slot.flags >> 2u) & 3u, (slot.flags & SLOT_NEAREST) != 0u);
    vec4 result = fetch_texel(slot.first_texel + f.indices.x) * f.weights.x;
    if ((slot.flags & SLOT_NEAREST) != 0u) return result;
    return result + fetch_texel(slot.first_texel + f.indices.y) * f.weights.y +
           fetch_texel(slot.first_texel + f.indices.z) * f.weights.z +
           fetch_texel(slot.first_texel + f.indices.w) * f.weights.w;
}

// ---- Vertices
// -----------------------------------------------------------------------------------------------------

FN float interpolate1(float a, float b, float c, vec2 barycentrics) {
    return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

FN vec3 interpolate3(vec3 a, vec3 b, vec3 c, vec2 barycentrics) {
    return a * (1.0f - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

FN uvec3 load_vertex_indices(InstanceRecord instance, uint primitive) {
    return fetch_triangle(instance.first_triangle + primitive) + uvec3(instance.first_vertex);
}

FN vec3 load_position_os(uint vertex) {
    return row_xyz(fetch_vertex_row(vertex * VERTEX_ROWS));
}

FN vec2 load_uv0(uint vertex) {
    uint row = vertex * VERTEX_ROWS;
    return vec2(uintBitsToFloat(fetch_vertex_row(row).w), uintBitsToFloat(fetch_vertex_row(row + 1u).w));
}

FN vec2 interpolate_uv0(uvec3 vertices, vec2 barycentrics) {
    vec2 a = load_uv0(vertices.x);
    vec2 b = load_uv0(vertices.y);
    vec2 c = load_uv0(vertices.z);
    return vec2(interpolate1(a.x, b.x, c.x, barycentrics), interpolate1(a.y, b.y, c.y, barycentrics));
}

// uv1 and colour share a row.
FN vec2 unpack_uv1(uvec4 row3) {
    return vec2(uintBitsToFloat(row3.x), uintBitsToFloat(row3.y));
}

FN vec4 unpack_color(uvec4 row3) {
    vec2 rg = unpackUnorm2x16(row3.z);
    vec2 ba = unpackUnorm2x16(row3.w);
    return vec4(rg.x, rg.y, ba.x, ba.y);
}

// Texture coordinates and colour at a point of a triangle.
struct VertexExtras {
    vec2 uv0;
    vec2 uv1;
    vec4 color;
};

FN VertexExtras interpolate_extras(uvec3 vertices, vec2 barycentrics) {
    uvec4 a = fetch_vertex_row(vertices.x * VERTEX_ROWS + 3u);
    uvec4 b = fetch_vertex_row(vertices.y * VERTEX_ROWS + 3u);
    uvec4 c = fetch_vertex_row(vertices.z * VERTEX_ROWS + 3u);
    float u = barycentrics.x;
    float v = barycentrics.y;
    float w = 1.0f - u - v;
    VertexExtras extras;
    extras.uv0 = interpolate_uv0(vertices, barycentrics);
    extras.uv1 = unpack_uv1(a) * w + unpack_uv1(b) * u + unpack_uv1(c) * v;
    // By differences: three equal colours stay what they are to the bit, so that an alpha that equals the
    // cutoff is not rounded below it.
    vec4 color = unpack_color(a);
    extras.color = color + (unpack_color(b) - color) * u + (unpack_color(c) - color) * v;
    return extras;
}

// ---- Coverage
// -----------------------------------------------------------------------------------------------------

// Opacity of the base colour at a point, for MASK and BLEND materials.
FN float load_opacity(uint instance, uint primitive, vec2 barycentrics) {
    InstanceRecord i = load_instance(instance);
    MaterialRecord m = load_material(i.material);
    VertexExtras extras = interpolate_extras(load_vertex_indices(i, primitive), barycentrics);
    SlotRecord slot = load_slot(i.material, SLOT_BASE_COLOR);
    return m.base_color.w * extras.color.w * sample_slot(slot, extras.uv0, extras.uv1).w;
}

// Whether a ray meets the surface there: MASK by its cutoff, BLEND with probability opacity (`u` in [0, 1)).
FN bool is_covered(uint material_flags, float alpha_cutoff, float opacity, float u) {
    if ((material_flags & MATERIAL_ALPHA_MASK) != 0u) return opacity >= alpha_cutoff;
    if ((material_flags & MATERIAL_ALPHA_BLEND) != 0u) return u < opacity;
    return true;
}

// ---- The surface
// --------------------------------------------------------------------------------------------------

FN float largest_absolute_term(InstanceRecord i, vec3 p0, vec3 p1, vec3 p2) {
    vec4 extent = vec4(max(abs(p0), max(abs(p1), abs(p2))), 1.0f);
    float x = dot(abs(i.world_from_object[0]), extent);
    float y = dot(abs(i.world_from_object[1]), extent);
    float z = dot(abs(i.world_from_object[2]), extent);
    return max(x, max(y, z));
}

FN vec3 apply_normal_map(vec3 normal, InstanceRecord i, MaterialRecord m, uvec3 vertices, VertexExtras extras,
                         vec2 barycentrics) {
    if (!SCENE_HAS_NORMAL_MAPS) return normal;
    SlotRecord slot = load_slot(i.material, SLOT_NORMAL);
    if ((slot.flags & SLOT_PRESENT) == 0u) return normal;
    vec4 t0 = row_xyzw(fetch_vertex_row(vertices.x * VERTEX_ROWS + 2u));
    vec4 t1 = row_xyzw(fetch_vertex_row(vertices.y * VERTEX_ROWS + 2u));
    vec4 t2 = row_xyzw(fetch_vertex_row(vertices.z * VERTEX_ROWS + 2u));
    vec3 tangent = transform_vector(i, interpolate3(vec3(t0), vec3(t1), vec3(t2), barycentrics));
    tangent = tangent - normal * dot(normal, tangent);
    float tangent_length = length(tangent);
    if (t0.w == 0.0f || tangent_length == 0.0f) return normal;
    tangent = tangent / tangent_length;
    // A mirroring transform turns the handedness of the frame.
    float handedness = (i.flags & INSTANCE_MIRRORED) != 0u ? -t0.w : t0.w;
    vec3 bitangent = cross(normal, tangent) * handedness;
    vec4 texel = sample_slot(slot, extras.uv0, extras.uv1);
    vec3 n = vec3((texel.x * 2.0f - 1.0f) * m.normal_scale, (texel.y * 2.0f - 1.0f) * m.normal_scale,
                  texel.z * 2.0f - 1.0f);
    vec3 mapped = tangent * n.x + bitangent * n.y + normal * n.z;
    float mapped_length = length(mapped);
    return mapped_length > 0.0f ? mapped / mapped_length : normal;
}

FN SurfaceMaterial evaluate_material(MaterialRecord m, uint material, VertexExtras extras, vec3 base_color) {
    vec4 mr = sample_slot(load_slot(material, SLOT_METALLIC_ROUGHNESS), extras.uv0, extras.uv1);
    float metallic = clamp(m.metallic * mr.z, 0.0f, 1.0f);
    float roughness = clamp(m.roughness * mr.y, 0.0f, 1.0f);
    return mix_material(base_color, metallic, m.dielectric_f0, m.dielectric_f90,
                        max(roughness * roughness, MIN_ALPHA));
}

// The surface at `barycentrics` (weights of the second and third vertex), seen along `direction` (unit,
// towards it).
FN Surface evaluate_surface(uint instance, uint primitive, vec2 barycentrics, vec3 direction) {
    InstanceRecord i = load_instance(instance);
    MaterialRecord m = load_material(i.material);
    uvec3 vertices = load_vertex_indices(i, primitive);
    vec3 p0 = load_position_os(vertices.x);
    vec3 p1 = load_position_os(vertices.y);
    vec3 p2 = load_position_os(vertices.z);
    VertexExtras extras = interpolate_extras(vertices, barycentrics);

    Surface s;
    s.point.position = transform_point(i, interpolate3(p0, p1, p2, barycentrics));
    s.point.position_error = position_error_bound(largest_absolute_term(i, p0, p1, p2));
    vec3 geometric = normalize_or_up(transform_normal(i, normalize_or_up(cross(p1 - p0, p2 - p0))));
    vec3 normal = transform_normal(
        i, interpolate3(row_xyz(fetch_vertex_row(vertices.x * VERTEX_ROWS + 1u)),
                        row_xyz(fetch_vertex_row(vertices.y * VERTEX_ROWS + 1u)),
                        row_xyz(fetch_vertex_row(vertices.z * VERTEX_ROWS + 1u)), barycentrics));
    float normal_length = length(normal);
    normal = normal_length > 0.0f ? normal / normal_length : geometric;
    normal = apply_normal_map(normal, i, m, vertices, extras, barycentrics);
    bool front = dot(geometric, direction) <= 0.0f;
    s.point.geometric_normal = front ? geometric : -geometric;
    s.point.shading_normal = front ? normal : -normal;
    if (dot(s.point.shading_normal, s.point.geometric_normal) <= 0.0f)
        s.point.shading_normal = s.point.geometric_normal;

    vec3 base_color = vec3(m.base_color) * vec3(extras.color) *
                      vec3(sample_slot(load_slot(i.material, SLOT_BASE_COLOR), extras.uv0, extras.uv1));
    s.unlit = (m.flags & MATERIAL_UNLIT) != 0u;
    s.point.material = evaluate_material(m, i.material, extras, base_color);
    bool emits = front || (m.flags & MATERIAL_DOUBLE_SIDED) != 0u;
    s.emission = emits ? m.emission : vec3(0.0f);
    if (max_component(s.emission) > 0.0f) {
        s.emission =
            s.emission * vec3(sample_slot(load_slot(i.material, SLOT_EMISSION), extras.uv0, extras.uv1));
    }
    if (s.unlit) s.emission = base_color;
    return s;
}
