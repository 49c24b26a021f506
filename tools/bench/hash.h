// Hashes that tell contents apart: 128 bits, of tables in memory and of files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

struct XXH3_state_s;

namespace tarn {

// Takes values and tables one by one. A table's size goes in too, so that two tables cannot run into each
// other. Records must have no padding.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    template <class Value>
    void add_value(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        add_bytes(&value, sizeof(value));
    }
    template <class Row>
    void add(const std::vector<Row>& rows) {
        static_assert(std::is_trivially_copyable_v<Row>);
        add_value(rows.size());
        add_bytes(rows.data(), rows.size() * sizeof(Row));
    }

    // 32 hexadecimal digits.
    std::string text() const;

  private:
    void add_bytes(const void* bytes, std::size_t size);

    XXH3_state_s* state_;
};

std::string hash_bytes(std::span<const unsigned char> bytes);
std::string hash_text(std::string_view text);

// Over this very program and all files of its shader folder: two runs with the same hash ran the same code.
// Throws Error where a file cannot be read.
std::string hash_program(const std::filesystem::path& shader_folder);

}  // namespace tarn
