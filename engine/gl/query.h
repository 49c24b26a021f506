// The time at which the device reaches a point in the command stream.
#pragma once

#include <cstdint>
#include <string>

#include "gl/handle.h"

namespace tarn {

class TimestampQuery {
  public:
    explicit TimestampQuery(const std::string& name);

    // Asks for the device's clock once all commands issued so far are done.
    void record();

    // The clock in nanoseconds of the last record(); blocks until it has come. Only differences mean
    // something.
    std::uint64_t read_ns() const;

    GLuint id() const { return handle_.id(); }

  private:
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
    Handle<destroy> handle_;
};

}  // namespace tarn
