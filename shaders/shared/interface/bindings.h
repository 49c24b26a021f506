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

// Texture units 9-13: the G-buffer.
#define UNIT_POSITION 9
#define UNIT_NORMALS 10
#define UNIT_DIFFUSE 11
#define UNIT_SPECULAR 12
#define UNIT_EMISSION 13

// Texture units 14-15: what the pass itself reads. GL 4.5 promises no more than 16 units a stage.
#define UNIT_PASS_A 14
#define UNIT_PASS_B 15

#define BLOCK_COUNTERS 7
#define BLOCK_FRAME 0
