// Compiling, linking and uniforms.
#include "gl/program.h"

#include <glm/gtc/type_ptr.hpp>

#include <vector>

#include "core/error.h"

namespace tarn {
namespace {

void destroy_shader(GLuint id) {
    glDeleteShader(id);
}
using Shader = Handle<destroy_shader>;

std::string read_shader_log(GLuint id) {
    GLint length = 0;
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length), '\0');
    if (length > 0) glGetShaderInfoLog(id, length, nullptr, log.data());
    return log;
}

std::string read_program_log(GLuint id) {
    GLint length = 0;
    glGetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(length), '\0');
    if (length > 0) glGetProgramInfoLog(id, length, nullptr, log.data());
    return log;
}

Shader compile(const std::string& program_name, const ShaderStage& stage) {
    Shader shader(glCreateShader(stage.type));
    set_label(GL_SHADER, shader.id(), program_name);
    const char* text = stage.source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
    if (compiled != GL_TRUE)
        throw Error("shader {} does not compile: {}", program_name,
                    translate_shader_log(stage.source, read_shader_log(shader.id())));
    return shader;
}

std::map<unsigned, std::size_t> read_block_sizes(GLuint program) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &count);
    std::map<unsigned, std::size_t> sizes;
    for (GLint block = 0; block < count; ++block) {
        const GLenum properties[] = {GL_BUFFER_BINDING, GL_BUFFER_DATA_SIZE};
        GLint values[2] = {};
        glGetProgramResourceiv(program, GL_UNIFORM_BLOCK, GLuint(block), 2, properties, 2, nullptr, values);
        sizes[unsigned(values[0])] = std::size_t(values[1]);
    }
    return sizes;
}

glm::ivec2 read_work_group_size(GLuint program) {
    GLint size[3] = {};
    glGetProgramiv(program, GL_COMPUTE_WORK_GROUP_SIZE, size);
    return {size[0], size[1]};
}

}  // namespace

void check_shader(const std::string& program_name, const ShaderStage& stage) {
    compile(program_name, stage);
}

Program::Program(std::string name, std::span<const ShaderStage> stages)
    : name_(std::move(name)), handle_(glCreateProgram()) {
    set_label(GL_PROGRAM, id(), name_);
    std::vector<Shader> shaders;
    for (const ShaderStage& stage : stages) {
        shaders.push_back(compile(name_, stage));
        glAttachShader(id(), shaders.back().id());
    }
    glLinkProgram(id());
    for (const Shader& shader : shaders) glDetachShader(id(), shader.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE)
        throw Error("shader {} does not link: {}", name_,
                    translate_shader_log(stages.front().source, read_program_log(id())));
    block_sizes_ = read_block_sizes(id());
    if (stages.front().type == GL_COMPUTE_SHADER) work_group_size_ = read_work_group_size(id());
}

void Program::set(std::string_view uniform, int value) const {
    glProgramUniform1i(id(), require_location(uniform), value);
}
void Program::set(std::string_view uniform, unsigned value) const {
    glProgramUniform1ui(id(), require_location(uniform), value);
}
void Program::set(std::string_view uniform, float value) const {
    glProgramUniform1f(id(), require_location(uniform), value);
}
void Program::set(std::string_view uniform, const glm::vec2& value) const {
    glProgramUniform2fv(id(), require_location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec3& value) const {
    glProgramUniform3fv(id(), require_location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec4& value) const {
    glProgramUniform4fv(id(), require_location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::ivec2& value) const {
    glProgramUniform2iv(id(), require_location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::uvec2& value) const {
    glProgramUniform2uiv(id(), require_location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), require_location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

GLint Program::require_location(std::string_view uniform) const {
    const GLint location = find_location(uniform);
#ifdef TARN_ASSERTIONS
    if (location < 0) throw Error("shader {} has no uniform '{}'", name_, uniform);
#endif
    return location;
}

std::size_t Program::uniform_block_size(unsigned binding) const {
    const auto found = block_sizes_.find(binding);
    return found == block_sizes_.end() ? 0 : found->second;
}

// GL itself ignores location -1, which stands for unknown names.
GLint Program::find_location(std::string_view uniform) const {
    const auto known = locations_.find(uniform);
    if (known != locations_.end()) return known->second;
    std::string name(uniform);
    const GLint location = glGetUniformLocation(id(), name.c_str());
    locations_.emplace(std::move(name), location);
    return location;
}

}  // namespace tarn
