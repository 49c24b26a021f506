// Where the texels of a surface lie, LAYER_* of `pixel`, in the table of a picture `width_px` wide.
#include "shared/interface/bindings.h"

int surface_texel(uint width_px, ivec2 pixel, int layer) {
    return (pixel.y * int(width_px) + pixel.x) * LAYER_STRIDE + layer;
}
