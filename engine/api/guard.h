// The border of the library: whatever is thrown below it leaves as tarn::api::Error.
#pragma once

#include <exception>
#include <new>

#include "core/error.h"
#include "tarn/error.h"

namespace tarn::api {

// What `work` returns. An error of the engine or of a library below it becomes an Error of the public
// surface.
template <class Work>
auto guard(const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error("there is not enough memory");
    } catch (const std::exception& error) {
        throw Error(error.what());
    }
}

}  // namespace tarn::api
