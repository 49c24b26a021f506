// How light has changed, second half: the share of it that is new, 0 to 1, as the mean over the cells around.
//
// A chosen sample stands for the light of its pixel in proportion to what it sends, so the mean over samples of what each
// has gained or lost, over the greater of before and now, is the share of the light that has changed.
#include "shared/interface/constants/light_changes.h"
#include "shared/dialect.h"
#include "lib/pixel_group.glsl"

layout(binding = UNIT_PASS_A) uniform sampler2D values;
layout(binding = UNIT_PASS_B) uniform samplerBuffer answers;
layout(binding = 0, r32f) writeonly uniform image2D out_changes;

// Change and weight.
void add_vote(inout vec2 sum, float now, float before, float weight) {
    float greater = max(now, before);
    bool counts = greater > 0.0f && is_finite(greater);
    sum += counts ? weight * vec2(abs(now - before) / greater, 1.0f) : vec2(0.0f);
}

void main() {
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    ivec2 cells = ivec2(cells_x, cells_y);
    if (cell.x >= cells.x || cell.y >= cells.y) return;
    const int REACH = 2;
    vec2 kept = vec2(0.0f);
    vec2 fresh = vec2(0.0f);
    for (int y = -REACH; y <= REACH; ++y) {
        for (int x = -REACH; x <= REACH; ++x) {
            ivec2 place = cell + ivec2(x, y);
            if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, cells))) continue;
            vec4 value = texelFetch(values, place, 0);
            if (traces != 0u) {
                int first = (place.y * cells.x + place.x) * int(CHANGE_RAYS);
                value *= vec4(texelFetch(answers, first).x, texelFetch(answers, first + 1).x,
                              texelFetch(answers, first + 2).x, texelFetch(answers, first + 3).x);
            }
            float weight = 1.0f / float(1 + x * x + y * y);
            add_vote(kept, value.x, value.y, weight);
            add_vote(fresh, value.z, value.w, weight);
        }
    }
    float change = max(kept.x / max(kept.y, 1.0f), fresh.x / max(fresh.y, 1.0f));
    imageStore(out_changes, cell, vec4(change));
}
