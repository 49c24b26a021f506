// Runs one kernel over a table of inputs; see kernels.h.
#include "gpu/shaders/kernels.h"

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Inputs { uvec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { uvec4 outputs[]; };

uniform uint kernel;

void main() {
    uint i = gl_GlobalInvocationID.x;
    outputs[i] = run_kernel(kernel, inputs[4u * i], inputs[4u * i + 1u], inputs[4u * i + 2u], inputs[4u * i + 3u]);
}
