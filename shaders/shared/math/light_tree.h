// A tree over lights from which one is drawn for a point: its nodes, and how much light a node may send.
//
// Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, with
// the bounds without trigonometry of pbrt (Pharr, Jakob and Humphreys, "Physically Based Rendering", 4th
// edition, section 12.6.3). Unlike in both a node holds intensity, not power: what its lights send at most in
// one direction. So a triangle and a point light that look alike from the front count alike.
//
// Table: row 0: the root (two rows); row 2: LightTreeHeader; from row 4 on pairs of siblings, each four rows,
// 64 bytes. Node k is at row 2 k, so that the sibling of k is k ^ 1. Then come the directional lights and the
// trails, four words a row.
#pragma once

#include "shared/dialect.h"
#include "shared/math/packing.h"

SHARED_BEGIN

CONSTANT uint LIGHT_TREE_NODE_ROWS = 2u;
CONSTANT uint LIGHT_TREE_HEADER_ROW = 2u;

// In LightTreeNode::link.
CONSTANT uint LIGHT_TREE_LEAF = 0x80000000u;
CONSTANT uint LIGHT_TREE_TWO_SIDED = 0x40000000u;
CONSTANT uint LIGHT_TREE_INDEX_MASK = 0x3fffffffu;

// A trail has a bit for each level, so no tree is deeper.
CONSTANT uint LIGHT_TREE_MAX_DEPTH = 32u;

// Probability with which a draw goes to the directional lights where there are others too. They are no part
// of the tree, since they have no place.
CONSTANT float DIRECTIONAL_SHARE = 0.25f;

// All lights below a node lie in the sphere. Each of their normals is within acos(cos_normals) of the axis
// or, where LIGHT_TREE_TWO_SIDED is set, of its opposite, and no light leaves a light at more than
// acos(cos_emission) from its normal.
struct LightTreeNode {
    vec3 centre;
    float radius;
    vec3 axis;
    float cos_normals;
    float cos_emission;
    float intensity;  // sum over the lights of what they send at most in one direction, luminance W/sr
    uint link;        // flags, and the light of a leaf, or the first child's number
};

struct LightTreeHeader {
    uint directional_count;
    uint directional_row;  // indices of lights
    uint trail_row;        // by light: bit d, lowest first, is set where its path turns right at depth d
    uint light_count;      // in the tree
};

FN LightTreeHeader unpack_light_tree_header(uvec4 row) {
    LightTreeHeader header;
    header.directional_count = row.x;
    header.directional_row = row.y;
    header.trail_row = row.z;
    header.light_count = row.w;
    return header;
}

FN uvec4 pack_light_tree_header(LightTreeHeader header) {
    return uvec4(header.directional_count, header.directional_row, header.trail_row, header.light_count);
}

// Cosines travel in 16 bits, rounded down, so that cones only widen.
FN uint pack_cosine(float x) {
    return uint(clamp(floor((x + 1.0f) * 32767.0f), 0.0f, 65534.0f));
}

FN float unpack_cosine(uint bits) {
    return float(bits) * (1.0f / 32767.0f) - 1.0f;
}

// What a direction becomes by being packed.
FN vec3 unpack_axis(uint bits) {
    vec2 p = unpackUnorm2x16(bits);
    return decode_octahedral(vec2(p.x * 2.0f - 1.0f, p.y * 2.0f - 1.0f));
}

FN uint pack_axis(vec3 axis) {
    vec2 p = encode_octahedral(axis);
    return packUnorm2x16(vec2(p.x * 0.5f + 0.5f, p.y * 0.5f + 0.5f));
}

// `node.cos_normals` must already allow for the rounding of the axis (see pack_axis).
FN void pack_light_tree_node(LightTreeNode node, OUT(uvec4) row0, OUT(uvec4) row1) {
    row0 = pack_row(node.centre, floatBitsToUint(node.radius));
    row1 =
        uvec4(pack_axis(node.axis), pack_cosine(node.cos_normals) | (pack_cosine(node.cos_emission) << 16u),
              floatBitsToUint(node.intensity), node.link);
}

FN LightTreeNode unpack_light_tree_node(uvec4 row0, uvec4 row1) {
    LightTreeNode node;
    node.centre = row_xyz(row0);
    node.radius = uintBitsToFloat(row0.w);
    node.axis = unpack_axis(row1.x);
    node.cos_normals = unpack_cosine(row1.y & 0xffffu);
    node.cos_emission = unpack_cosine(row1.y >> 16u);
    node.intensity = uintBitsToFloat(row1.z);
    node.link = row1.w;
    return node;
}

// Sine of an angle in [0, pi] by its cosine.
FN float sine_of(float cosine) {
    return sqrt(max(0.0f, 1.0f - cosine * cosine));
}

// Cosine of max(0, a - b), for angles in [0, pi] by their cosines and sines.
FN float cos_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

// Sine of max(0, a - b).
FN float sin_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

// Angles are taken to be so much wider than they are (radians), that no rounding here or in the evaluation
// of a light makes a light vanish that just grazes a horizon.
CONSTANT float LIGHT_TREE_SLACK = 1e-3f;
// Keeps what may contribute above 0 where the product underflows, and below infinity at a light's very place.
CONSTANT float LIGHT_TREE_LEAST_IMPORTANCE = 1e-36f;
CONSTANT float LIGHT_TREE_LEAST_DISTANCE2 = 1e-20f;

// Lights are taken to be no nearer than half the radius of their node. (With the radius itself groups around
// the point count too little: three times the variance at 1 000 lights, six times at 30 000, many_lights.)
CONSTANT float LIGHT_TREE_NEAREST2 = 0.25f;

// Irradiance that the node's lights may bring at most to a surface at `position` with unit `normal`, roughly:
// distances are those to the centre, but not less than half the radius. Exactly 0 only where none of the
// lights reaches the front of the surface.
FN float light_tree_importance(LightTreeNode node, vec3 position, vec3 normal) {
    vec3 to_centre = node.centre - position;
    float distance2 = dot(to_centre, to_centre);
    float radius2 = node.radius * node.radius;
    bool inside = distance2 <= radius2;
    float inverse_distance = 1.0f / sqrt(max(distance2, LIGHT_TREE_LEAST_DISTANCE2));
    vec3 direction = to_centre * inverse_distance;

    // Half the angle under which the sphere is seen.
    float sin_sphere = min(1.0f, node.radius * inverse_distance + LIGHT_TREE_SLACK);
    float cos_sphere = inside ? -1.0f : sine_of(sin_sphere);
    sin_sphere = inside ? 0.0f : sin_sphere;

    // The smallest angle between a light's normal and the way from it to the point.
    float cos_axis = -dot(node.axis, direction);
    cos_axis = (node.link & LIGHT_TREE_TWO_SIDED) != 0u ? abs(cos_axis) : cos_axis;
    float sin_axis = sine_of(cos_axis);
    float sin_normals = sine_of(node.cos_normals);
    float cos_outside = cos_difference(cos_axis, sin_axis, node.cos_normals, sin_normals);
    float sin_outside = sin_difference(cos_axis, sin_axis, node.cos_normals, sin_normals);
    float cos_light = cos_difference(cos_outside, sin_outside, cos_sphere, sin_sphere);

    // The smallest angle between the surface's normal and the way to a light.
    float cos_centre = dot(normal, direction);
    float cos_surface = cos_difference(cos_centre, sine_of(cos_centre), cos_sphere, sin_sphere);

    bool reaches = cos_light >= node.cos_emission && cos_light > 0.0f && cos_surface > 0.0f;
    float importance = node.intensity * cos_light * cos_surface /
                       max(max(distance2, LIGHT_TREE_NEAREST2 * radius2), LIGHT_TREE_LEAST_DISTANCE2);
    return reaches ? max(importance, LIGHT_TREE_LEAST_IMPORTANCE) : 0.0f;
}

// Of the 2^24 values that float_from_bits may take, how many lead to the left of two siblings. A side with
// any importance keeps one value at least; where neither has any, which happens below a node whose bounds are
// wider than those of both, intensity decides, so that a draw always ends at a light.
FN uint light_tree_left_share(LightTreeNode left, LightTreeNode right, float left_importance,
                              float right_importance) {
    bool dead = !(left_importance + right_importance > 0.0f);
    float l = dead ? left.intensity : left_importance;
    float r = dead ? right.intensity : right_importance;
    float share = clamp(l / (l + r), 0.0f, 1.0f);
    return clamp(uint(share * 16777216.0f), l > 0.0f ? 1u : 0u, r > 0.0f ? 16777215u : 16777216u);
}

SHARED_END
