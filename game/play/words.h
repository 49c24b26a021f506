// The words of a line of a text file, taken in turn.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <system_error>

#include "../tarn_names.h"

namespace game {

// Each function throws a message without file and line where the word is not what it must be.
class Words {
  public:
    explicit Words(const std::string& line) : stream_(line) {}

    std::string take(const char* what) {
        std::string word;
        if (!(stream_ >> word)) throw Error(fmt::format("{} is missing", what));
        return word;
    }
    std::string take_rest(const char* what) {
        std::string rest;
        std::getline(stream_ >> std::ws, rest);
        if (rest.empty()) throw Error(fmt::format("{} is missing", what));
        return rest;
    }
    long long take_number(const char* what, long long least, long long most) {
        const std::string word = take(what);
        std::size_t used = 0;
        long long value = 0;
        try {
            value = std::stoll(word, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used != word.size() || value < least || value > most)
            throw Error(fmt::format("{} is '{}', it must be {} to {}", what, word, least, most));
        return value;
    }
    std::uint64_t take_hash(const char* what) {
        const std::string word = take(what);
        if (word.size() != 16 || word.find_first_not_of("0123456789abcdef") != std::string::npos)
            throw Error(fmt::format("{} is '{}', it must be 16 hexadecimal digits", what, word));
        return std::stoull(word, nullptr, 16);
    }
    // Not more than `most` from 0; finite.
    template <class Number>
    Number take_real(const char* what, double most) {
        const std::string word = take(what);
        Number value{};
        const auto [rest, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_number = failure == std::errc() && rest == word.data() + word.size();
        if (!is_number || !(std::abs(double(value)) <= most))
            throw Error(
                fmt::format("{} is '{}', it must be a number from {} to {}", what, word, -most, most));
        return value;
    }
    bool has_more() { return !(stream_ >> std::ws).eof(); }
    void end() {
        std::string word;
        if (stream_ >> word) throw Error(fmt::format("'{}' is one word too many", word));
    }

  private:
    std::istringstream stream_;
};

}  // namespace game
