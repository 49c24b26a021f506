// Vertex inputs.
#include "gl/vertex_array.h"

namespace tarn {
namespace {

GLuint create_vertex_array() {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    return id;
}

}  // namespace

VertexArray::VertexArray(const std::string& name) : handle_(create_vertex_array()) {
    set_label(GL_VERTEX_ARRAY, id(), name);
}

void VertexArray::add_float_attribute(unsigned location, int component_count, const Buffer& buffer,
                                      std::size_t offset_bytes, std::size_t stride_bytes, unsigned divisor) {
    attach(location, buffer, offset_bytes, stride_bytes, divisor);
    glVertexArrayAttribFormat(id(), location, component_count, GL_FLOAT, GL_FALSE, 0);
}

void VertexArray::add_uint_attribute(unsigned location, int component_count, const Buffer& buffer,
                                     std::size_t offset_bytes, std::size_t stride_bytes, unsigned divisor) {
    attach(location, buffer, offset_bytes, stride_bytes, divisor);
    glVertexArrayAttribIFormat(id(), location, component_count, GL_UNSIGNED_INT, 0);
}

void VertexArray::set_index_buffer(const Buffer& buffer) {
    glVertexArrayElementBuffer(id(), buffer.id());
}

// One binding point per attribute: the vertex streams of a mesh are separate arrays.
void VertexArray::attach(unsigned location, const Buffer& buffer, std::size_t offset_bytes,
                         std::size_t stride_bytes, unsigned divisor) {
    glEnableVertexArrayAttrib(id(), location);
    glVertexArrayVertexBuffer(id(), location, buffer.id(), GLintptr(offset_bytes), GLsizei(stride_bytes));
    glVertexArrayAttribBinding(id(), location, location);
    glVertexArrayBindingDivisor(id(), location, divisor);
}

}  // namespace tarn
