/// @file
/// Checks of sizes, indices and models at the library's public interface, active in every build: a wrong argument is an
/// InputError and never an access out of bounds. The cost is one comparison per argument; the code that builds the
/// message is kept out of line.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>

namespace cardan {

/// "<where>: size of <what> = 3 x 1; allowed: 7 x 1"
[[noreturn]] void refuse_size(const char* where, const char* what, Eigen::Index rows, Eigen::Index cols,
                              Eigen::Index right_rows, Eigen::Index right_cols);
/// "<where>: <what> = 9; allowed: 0 ... 6"
[[noreturn]] void refuse_index(const char* where, const char* what, std::ptrdiff_t index, std::ptrdiff_t count);
/// "<where>: the <what> belongs to another model"
[[noreturn]] void refuse_model(const char* where, const char* what);

/// @throws InputError unless A is rows x cols
template <class Derived>
void require_size(const char* where, const char* what, const Eigen::EigenBase<Derived>& A, Eigen::Index rows,
                  Eigen::Index cols = 1) {
    if (A.rows() != rows || A.cols() != cols) [[unlikely]]
        refuse_size(where, what, A.rows(), A.cols(), rows, cols);
}
/// Checks the number of anything that is counted.
inline void require_count(const char* where, const char* what, std::size_t size, std::size_t right) {
    if (size != right) [[unlikely]]
        refuse_size(where, what, static_cast<Eigen::Index>(size), 1, static_cast<Eigen::Index>(right), 1);
}

/// @throws InputError unless 0 <= index < count
inline void require_index(const char* where, const char* what, std::ptrdiff_t index, std::ptrdiff_t count) {
    if (index < 0 || index >= count) [[unlikely]]
        refuse_index(where, what, index, count);
}

/// @throws InputError unless both serial numbers are those of one model (Model::serial())
inline void require_model(const char* where, const char* what, std::uint64_t serial, std::uint64_t right) {
    if (serial != right) [[unlikely]]
        refuse_model(where, what);
}

}  // namespace cardan
