// Where each pass finds its resources: texture units, storage blocks and the uniform block of the frame.
#pragma once

// Texture units 0-8: the scene, the same for every pass (GpuScene::bind).
#define UNIT_VERTEX_ROWS 0
#define UNIT_TRIANGLES 1
#define UNIT_INSTANCE_ROWS 2
#define UNIT_MATERIAL_ROWS 3
#define UNIT_TEXELS 4
#define UNIT_LIGHT_ROWS 5
#define UNIT_LIGHT_ALIAS 6
#define UNIT_ENVIRONMENT_TEXELS 7
#define UNIT_ENVIRONMENT_ALIAS 8

// Texture units 9-10: the surfaces that this frame and the one before see (a buffer texture each).
#define UNIT_SURFACE 9
#define UNIT_PREVIOUS_SURFACE 10

// Texture units 11-15: what the pass itself reads. GL 4.5 promises no more than 16 units a stage.
#define UNIT_PASS_A 11
#define UNIT_PASS_B 12
#define UNIT_PASS_C 13
#define UNIT_PASS_D 14
#define UNIT_PASS_E 15

// Texels of a surface; what they hold: shaders/passes/gbuffer/resolve.comp. Those of a pixel follow one
// another: the first four, which reuse reads of neighbours, fill a line of the cache.
#define LAYER_POSITION 0
#define LAYER_NORMALS 1
#define LAYER_DIFFUSE 2
#define LAYER_SPECULAR 3
#define LAYER_EMISSION 4
#define LAYER_MOTION 5
#define LAYER_COUNT 6
#define LAYER_STRIDE 8

// Uniform blocks.
#define BLOCK_FRAME 0
#define BLOCK_PASS 1

// Storage blocks: 0 upwards are the pass's own.
#define BLOCK_COUNTERS 7
