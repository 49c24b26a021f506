// The three kinds of contexts, for context.cpp alone.
#pragma once

#include <memory>

#include "platform/context.h"

namespace tarn {

std::unique_ptr<Context> create_egl_context(const ContextOptions& options);
std::unique_ptr<Context> create_glfw_context(const ContextOptions& options);
std::unique_ptr<Context> create_osmesa_context(const ContextOptions& options);

}  // namespace tarn
