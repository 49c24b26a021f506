// How the library fails.
#pragma once

#include <stdexcept>

namespace tarn::api {

// The world disappoints: a file, a scene, a driver, a value out of its range. The message is one line that
// names the thing and what is wrong with it.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace tarn::api
