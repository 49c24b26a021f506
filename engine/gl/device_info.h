// Which driver and device draws, and its limits.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace tarn {

struct DeviceLimits {
    std::int64_t texture_side_px = 0;
    std::int64_t texture_array_layers = 0;
    std::int64_t texture_buffer_texels = 0;
    std::int64_t storage_block_bytes = 0;
    std::int64_t storage_block_bindings = 0;
    std::int64_t uniform_block_bytes = 0;
    std::int64_t workgroup_invocations = 0;
    std::int64_t workgroup_shared_bytes = 0;
    std::array<std::int64_t, 3> workgroup_count = {};
};

struct DeviceInfo {
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string mesa_version;  // "22.3.6", empty for other drivers
    int gl_major = 0;
    int gl_minor = 0;
    bool is_core_profile = false;
    bool is_software = false;  // draws on the CPU
    DeviceLimits limits;
};

// Describes the current context.
DeviceInfo query_device_info();

}  // namespace tarn
