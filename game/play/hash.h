// A hash of numbers as their bits are: FNV-1a, 64 bits.
#pragma once

#include <cstdint>
#include <cstring>

namespace game {

class Hash {
  public:
    template <class Number>
    void add(const Number& number) {
        unsigned char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3u;
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace game
