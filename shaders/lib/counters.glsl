// Counters of what is dropped or clamped, so that no loss goes unnoticed.
#include "shared/interface/bindings.h"
#include "shared/interface/frame_block.h"

layout(std430, binding = BLOCK_COUNTERS) buffer Counters { uint counters[]; };

void count_event(uint counter) { atomicAdd(counters[counter], 1u); }
