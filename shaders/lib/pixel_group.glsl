// One invocation a pixel. The shape of their groups is that which suits the driver (engine/gl/driver_quirks.h) and changes
// no result.
#ifdef TARN_ROW_GROUPS
layout(local_size_x = 64, local_size_y = 1) in;
#else
layout(local_size_x = 8, local_size_y = 8) in;
#endif
