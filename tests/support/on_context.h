// Test suites that need a current GL context.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "platform/context.h"

namespace tarn::test {

// `Base` (testing::Test, or TestWithParam) with one context for all tests of a suite.
template <class Base = testing::Test>
class OnContext : public Base {
  protected:
    static void SetUpTestSuite() { context_ = create_context({}); }
    static void TearDownTestSuite() { context_.reset(); }

    static inline std::unique_ptr<Context> context_;
};

// The same with a context that records the driver's complaints (take_debug_errors).
template <class Base = testing::Test>
class OnDebugContext : public OnContext<Base> {
  protected:
    static void SetUpTestSuite() {
        ContextOptions options;
        options.debug = true;
        OnContext<Base>::context_ = create_context(options);
    }
};

}  // namespace tarn::test
