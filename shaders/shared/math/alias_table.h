// Drawing from a discrete distribution in constant time (Walker 1977, Vose 1991).
#pragma once

#include "shared/dialect.h"

SHARED_BEGIN

// One bucket: with probability `threshold` the bucket's own index, else `alias`. Both their probabilities
// travel along, so that one load answers a draw.
struct AliasBucket {
    float threshold;
    uint alias;
    float pmf_own;
    float pmf_alias;
};

struct DiscreteSample {
    uint index;
    float pmf;
};

// One of `count` indices from 32 random bits. (A float's 24 bits would favour some of a million by 6 %.)
FN uint uniform_index(uint bits, uint count) {
    return multiply_high(bits, count);
}

FN DiscreteSample resolve_alias(AliasBucket bucket, uint bucket_index, float u) {
    DiscreteSample result;
    bool own = u < bucket.threshold;
    result.index = own ? bucket_index : bucket.alias;
    result.pmf = own ? bucket.pmf_own : bucket.pmf_alias;
    return result;
}

FN AliasBucket unpack_alias_bucket(uvec4 row) {
    AliasBucket bucket;
    bucket.threshold = uintBitsToFloat(row.x);
    bucket.alias = row.y;
    bucket.pmf_own = uintBitsToFloat(row.z);
    bucket.pmf_alias = uintBitsToFloat(row.w);
    return bucket;
}

FN uvec4 pack_alias_bucket(AliasBucket bucket) {
    return uvec4(floatBitsToUint(bucket.threshold), bucket.alias, floatBitsToUint(bucket.pmf_own),
                 floatBitsToUint(bucket.pmf_alias));
}

SHARED_END
