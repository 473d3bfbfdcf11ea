/// @file
/// Binary files as strings of bytes.
#pragma once

#include <cstring>
#include <string>

namespace cardan::test {

/// Numbers one after the other.
struct Bytes {
    std::string all;
    template <class... Numbers>
    Bytes& add(const Numbers&... numbers) {
        (all.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
        return *this;
    }
    template <class Number>
    Bytes& put(std::size_t at, const Number& number) {
        std::memcpy(all.data() + at, &number, sizeof number);
        return *this;
    }
};

}  // namespace cardan::test
