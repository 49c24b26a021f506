// Timestamp queries.
#include "gl/query.h"

namespace tarn {
namespace {

GLuint create_query() {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    return id;
}

}  // namespace

TimestampQuery::TimestampQuery(const std::string& name) : handle_(create_query()) {
    set_label(GL_QUERY, id(), name);
}

void TimestampQuery::record() {
    glQueryCounter(id(), GL_TIMESTAMP);
}

std::uint64_t TimestampQuery::read_ns() const {
    GLuint64 time_ns = 0;
    glGetQueryObjectui64v(id(), GL_QUERY_RESULT, &time_ns);
    return time_ns;
}

}  // namespace tarn
