// Drawing a light by the tree, for a point and its normal. One text for shaders and the CPU; included after
// scene/lights.h.
//
// Also needs, where it is included:
//     uvec4 fetch_light_tree_row(uint), uint get_light_tree_node_count() (0: there are no lights to draw)

FN LightTreeNode load_light_tree_node(uint node) {
    uint row = node * LIGHT_TREE_NODE_ROWS;
    return unpack_light_tree_node(fetch_light_tree_row(row), fetch_light_tree_row(row + 1u));
}

FN LightTreeHeader load_light_tree_header() {
    return unpack_light_tree_header(fetch_light_tree_row(LIGHT_TREE_HEADER_ROW));
}

// Word `index` of the words that begin at `row`.
FN uint load_light_tree_word(uint row, uint index) {
    uvec4 words = fetch_light_tree_row(row + (index >> 2u));
    uint low = (index & 1u) == 0u ? words.x : words.y;
    uint high = (index & 1u) == 0u ? words.z : words.w;
    return (index & 2u) == 0u ? low : high;
}

// Probability that a draw goes to the directional lights.
FN float light_tree_directional_probability(LightTreeHeader header) {
    if (header.light_count == 0u) return 1.0f;
    return header.directional_count > 0u ? DIRECTIONAL_SHARE : 0.0f;
}

// Two siblings, and the share of draws that goes to the left one.
struct LightTreePair {
    uint left_link;
    uint right_link;
    uint left_share;  // of 2^24
};

FN LightTreePair load_light_tree_pair(uint first_child, vec3 position, vec3 normal) {
    LightTreeNode left = load_light_tree_node(first_child);
    LightTreeNode right = load_light_tree_node(first_child + 1u);
    LightTreePair pair;
    pair.left_link = left.link;
    pair.right_link = right.link;
    pair.left_share = light_tree_left_share(left, right, light_tree_importance(left, position, normal),
                                            light_tree_importance(right, position, normal));
    return pair;
}

// A light of the tree or a directional one, and its probability for this point. Bits are drawn anew at each
// level: one number stretched over all levels would run out of digits.
FN DiscreteSample choose_light_by_tree(uvec4 bits, vec3 position, vec3 normal) {
    LightTreeHeader header = load_light_tree_header();
    float directional_probability = light_tree_directional_probability(header);
    bool directional = float_from_bits(bits.x) < directional_probability;
    uint place = uniform_index(bits.y, max(header.directional_count, 1u));
    uint light = load_light_tree_word(header.directional_row, directional ? place : 0u);
    uint link = directional ? (light | LIGHT_TREE_LEAF) : load_light_tree_node(0u).link;
    DiscreteSample chosen;
    chosen.pmf = directional ? directional_probability / float(header.directional_count)
                             : 1.0f - directional_probability;
    uvec4 walk = bits;
    while ((link & LIGHT_TREE_LEAF) == 0u) {
        walk = hash_pcg4d(walk);
        LightTreePair pair = load_light_tree_pair(link & LIGHT_TREE_INDEX_MASK, position, normal);
        bool goes_left = (walk.x >> 8u) < pair.left_share;
        link = goes_left ? pair.left_link : pair.right_link;
        uint share = goes_left ? pair.left_share : 16777216u - pair.left_share;
        chosen.pmf *= float(share) * (1.0f / 16777216.0f);
    }
    chosen.index = link & LIGHT_TREE_INDEX_MASK;
    return chosen;
}

// Probability with which choose_light_by_tree gives `light` for this point; 0 for a light that it never
// gives.
FN float light_tree_pmf(uint light, vec3 position, vec3 normal) {
    if (get_light_tree_node_count() == 0u) return 0.0f;
    LightTreeHeader header = load_light_tree_header();
    float directional_probability = light_tree_directional_probability(header);
    if ((fetch_light_row(light * LIGHT_ROWS).w & LIGHT_KIND_MASK) == LIGHT_DIRECTIONAL) {
        return directional_probability / float(header.directional_count);
    }
    if (header.light_count == 0u) return 0.0f;
    uint trail = load_light_tree_word(header.trail_row, light);
    uint link = load_light_tree_node(0u).link;
    float pmf = 1.0f - directional_probability;
    while ((link & LIGHT_TREE_LEAF) == 0u) {
        LightTreePair pair = load_light_tree_pair(link & LIGHT_TREE_INDEX_MASK, position, normal);
        bool goes_left = (trail & 1u) == 0u;
        trail = trail >> 1u;
        link = goes_left ? pair.left_link : pair.right_link;
        uint share = goes_left ? pair.left_share : 16777216u - pair.left_share;
        pmf *= float(share) * (1.0f / 16777216.0f);
    }
    return (link & LIGHT_TREE_INDEX_MASK) == light ? pmf : 0.0f;
}

// A sample of the lights other than the sky, for a surface at `position` (relative to the world's origin)
// with unit `normal`. Its density has the light's own measure, as in math/light.h. `bits`: as from
// random_bits4.
FN LightCandidate draw_light_by_tree(uvec4 bits, vec3 position, vec3 normal) {
    if (get_light_tree_node_count() == 0u) return no_candidate();
    DiscreteSample light = choose_light_by_tree(bits, position, normal);
    return draw_on_light(light.index, light.pmf, vec2(float_from_bits(bits.z), float_from_bits(bits.w)));
}

// The same for a receiver at `position`: near triangles evenly over their solid angle (draw_on_light_near).
FN LightCandidate draw_light_near_by_tree(uvec4 bits, vec3 position, vec3 normal) {
    if (get_light_tree_node_count() == 0u) return no_candidate();
    DiscreteSample light = choose_light_by_tree(bits, position, normal);
    return draw_on_light_near(light.index, light.pmf, vec2(float_from_bits(bits.z), float_from_bits(bits.w)),
                              position);
}
