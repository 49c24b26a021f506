// Questions to the driver.
#include "gl/device_info.h"

#include <regex>

#include "gl/handle.h"

namespace tarn {
namespace {

std::string read_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

std::string parse_mesa_version(const std::string& version) {
    static const std::regex PATTERN(R"(Mesa (\d+(\.\d+)*))");
    std::smatch match;
    return std::regex_search(version, match, PATTERN) ? match[1].str() : "";
}

bool is_software_renderer(const std::string& renderer) {
    for (const char* name : {"llvmpipe", "softpipe", "SWR", "SwiftShader"})
        if (renderer.find(name) != std::string::npos) return true;
    return false;
}

// Limits that a context below 4.3 does not know stay 0.
DeviceLimits query_limits() {
    DeviceLimits limits;
    limits.texture_side_px = get_gl_limit(GL_MAX_TEXTURE_SIZE);
    limits.texture_array_layers = get_gl_limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
    limits.texture_buffer_texels = get_gl_limit(GL_MAX_TEXTURE_BUFFER_SIZE);
    limits.storage_block_bytes = get_gl_limit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    limits.storage_block_bindings = get_gl_limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS);
    limits.uniform_block_bytes = get_gl_limit(GL_MAX_UNIFORM_BLOCK_SIZE);
    limits.workgroup_invocations = get_gl_limit(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
    limits.workgroup_shared_bytes = get_gl_limit(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
    for (GLuint axis = 0; axis < 3; ++axis)
        glGetInteger64i_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &limits.workgroup_count[axis]);
    return limits;
}

}  // namespace

DeviceInfo query_device_info() {
    DeviceInfo info;
    info.vendor = read_string(GL_VENDOR);
    info.renderer = read_string(GL_RENDERER);
    info.version = read_string(GL_VERSION);
    info.mesa_version = parse_mesa_version(info.version);
    info.is_software = is_software_renderer(info.renderer);
    info.gl_major = int(get_gl_limit(GL_MAJOR_VERSION));
    info.gl_minor = int(get_gl_limit(GL_MINOR_VERSION));
    info.is_core_profile = (get_gl_limit(GL_CONTEXT_PROFILE_MASK) & GL_CONTEXT_CORE_PROFILE_BIT) != 0;
    info.limits = query_limits();
    return info;
}

}  // namespace tarn
