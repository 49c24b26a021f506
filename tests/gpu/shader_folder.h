// A folder of shaders that a test writes for itself and that vanishes with it.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tarn {

class ShaderFolder {
  public:
    ShaderFolder() {
        static int count = 0;
        root_ = std::filesystem::path(testing::TempDir()) /
                ("tarn_shaders_" + std::to_string(getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(root_);
    }
    ~ShaderFolder() { std::filesystem::remove_all(root_); }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;

    // Writes root / `file`, with the folders it needs.
    void write(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories((root_ / file).parent_path());
        std::ofstream(root_ / file) << text;
    }

    const std::filesystem::path& root() const { return root_; }

  private:
    std::filesystem::path root_;
};

// The message of the Error that `function` throws; fails the test where it throws none.
template <class Exception, class Function>
std::string catch_message(Function function) {
    try {
        function();
    } catch (const Exception& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

}  // namespace tarn
