// What a frame keeps for the next one: the only way in which a pass may look back in time.
#pragma once

#include <array>

namespace tarn {

template <class T>
class History;

// What the frame before wrote. Only a History hands it out, so that the frame recorder need not ask who wrote
// it.
template <class T>
class Past {
  public:
    const T& value() const { return value_; }

  private:
    friend class History<T>;
    explicit Past(const T& value) : value_(value) {}
    const T& value_;
};

// Two of a kind: one is written by this frame, the other holds what the last frame wrote.
template <class T>
class History {
  public:
    // Both are made by `make()`.
    template <class Make>
    explicit History(const Make& make) : items_{make(), make()} {}

    T& current() { return items_[current_]; }
    const T& current() const { return items_[current_]; }
    Past<T> previous() const { return Past<T>(items_[1 - current_]); }

    // Ends a frame: what is current becomes the past.
    void advance() { current_ = 1 - current_; }

  private:
    std::array<T, 2> items_;
    std::size_t current_ = 0;
};

}  // namespace tarn
