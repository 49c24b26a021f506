// What a frame keeps for the next one: the only way in which a pass may look back in time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace tarn {

// A value of the frame before. Only a History makes one, after asking which frame that was: so the frame
// recorder need not ask who wrote it.
template <class T>
class Previous {
  public:
    const T& value() const { return value_; }

  private:
    template <class>
    friend class History;
    explicit Previous(T value) : value_(std::move(value)) {}
    T value_;
};

// The latest value of its kind and the frame that kept it.
template <class T>
class History {
  public:
    // What frame `frame` kept; nothing where another frame was the last to keep something.
    std::optional<Previous<T>> of_frame(std::uint32_t frame) const {
        if (!value_ || frame_ != frame) return std::nullopt;
        return Previous<T>(*value_);
    }

    void keep(std::uint32_t frame, T value) {
        frame_ = frame;
        value_ = std::move(value);
    }

  private:
    std::uint32_t frame_ = 0;
    std::optional<T> value_;
};

}  // namespace tarn
