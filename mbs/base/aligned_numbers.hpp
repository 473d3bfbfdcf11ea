/// @file
/// Memory for numbers that loops load four at a time.
#pragma once

#include <cstddef>
#include <vector>

namespace cardan {

/// Blocks of four numbers, the first at a multiple of 32 bytes; all zero at first.
class AlignedNumbers {
public:
    AlignedNumbers() = default;
    explicit AlignedNumbers(std::size_t blocks) : blocks_(blocks) {}

    std::size_t blocks() const { return blocks_.size(); }
    double* data() { return reinterpret_cast<double*>(blocks_.data()); }
    const double* data() const { return reinterpret_cast<const double*>(blocks_.data()); }

private:
    struct alignas(32) Block {
        double x[4] = {};
    };
    std::vector<Block> blocks_;
};

}  // namespace cardan
