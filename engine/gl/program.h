// A linked GLSL program and its uniforms.
#pragma once

#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "gl/handle.h"
#include "gl/shader_source.h"

namespace tarn {

// One stage of a program: GL_COMPUTE_SHADER, GL_VERTEX_SHADER or GL_FRAGMENT_SHADER.
struct ShaderStage {
    GLenum type;
    ShaderSource source;
};

// Compiles a shader and throws it away. Error as of a Program of this name.
void check_shader(const std::string& program_name, const ShaderStage& stage);

class Program {
  public:
    // Compiles and links. Error on one line with the program's name, file:line and the driver's messages.
    Program(std::string name, std::span<const ShaderStage> stages);

    void use() const { glUseProgram(id()); }

    // Sets a uniform by name, whether or not the program is in use. A name that the program does not have (or
    // that the compiler dropped as unused) is an Error where assertions are on, else ignored. Passes of a
    // frame have constants instead (PassRecorder::constants).
    void set(std::string_view uniform, int value) const;
    void set(std::string_view uniform, unsigned value) const;
    void set(std::string_view uniform, float value) const;
    void set(std::string_view uniform, const glm::vec2& value) const;
    void set(std::string_view uniform, const glm::vec3& value) const;
    void set(std::string_view uniform, const glm::vec4& value) const;
    void set(std::string_view uniform, const glm::ivec2& value) const;
    void set(std::string_view uniform, const glm::uvec2& value) const;
    void set(std::string_view uniform, const glm::mat4& value) const;

    // True when the linked program has this uniform.
    bool has_uniform(std::string_view uniform) const { return find_location(uniform) >= 0; }

    // Bytes of the uniform block that the program reads at `binding`, as the driver lays it out; 0: none.
    std::size_t uniform_block_size(unsigned binding) const;

    // Invocations of a work group along x and y; 0 for programs without a compute shader.
    glm::ivec2 work_group_size() const { return work_group_size_; }

    const std::string& name() const { return name_; }
    GLuint id() const { return handle_.id(); }

  private:
    static void destroy(GLuint id) { glDeleteProgram(id); }

    GLint find_location(std::string_view uniform) const;
    GLint require_location(std::string_view uniform) const;

    std::string name_;
    Handle<destroy> handle_;
    mutable std::map<std::string, GLint, std::less<>> locations_;
    std::map<unsigned, std::size_t> block_sizes_;  // by binding
    glm::ivec2 work_group_size_{0};
};

}  // namespace tarn
