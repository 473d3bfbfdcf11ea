/// @file
/// What MATLAB files hold, by libmatio.
#pragma once

#include "mbs/base/types.hpp"
#include "tests/support/catch.hpp"

#include <cstdint>
#include <matio.h>
#include <memory>
#include <string>

namespace cardan::test {

struct FreeVariable {
    void operator()(matvar_t* v) const { Mat_VarFree(v); }
};
using MatVariable = std::unique_ptr<matvar_t, FreeVariable>;

inline MatVariable read_variable(const std::string& path, const char* name) {
    mat_t* file = Mat_Open(path.c_str(), MAT_ACC_RDONLY);
    REQUIRE(file != nullptr);
    MatVariable found(Mat_VarRead(file, name));
    Mat_Close(file);
    REQUIRE(found != nullptr);
    return found;
}

inline const matvar_t* field(const MatVariable& structure, const char* name) {
    const matvar_t* found = Mat_VarGetStructFieldByName(structure.get(), name, 0);
    REQUIRE(found != nullptr);
    return found;
}

/// @param slice  along the third axis
inline Matrix numbers(const matvar_t* v, std::size_t slice = 0) {
    REQUIRE(v->class_type == MAT_C_DOUBLE);
    const auto rows = static_cast<Eigen::Index>(v->dims[0]), columns = static_cast<Eigen::Index>(v->dims[1]);
    return Eigen::Map<const Matrix>(static_cast<const double*>(v->data) + slice * v->dims[0] * v->dims[1], rows,
                                    columns);
}

/// As UTF-8.
inline std::string characters(const matvar_t* v) {
    std::string out;
    if (v->data_type != MAT_T_UTF16) {
        REQUIRE(v->nbytes == 0);
        return out;
    }
    const auto* units = static_cast<const std::uint16_t*>(v->data);
    const auto add = [&](std::uint32_t bits) { out += static_cast<char>(bits); };
    for (std::size_t i = 0; i < v->nbytes / 2; ++i) {
        std::uint32_t code = units[i];
        if (code >= 0xD800 && code < 0xDC00) code = 0x10000 + ((code - 0xD800) << 10) + (units[++i] - 0xDC00u);
        if (code < 0x80)
            add(code);
        else if (code < 0x800)
            add(0xC0 | code >> 6), add(0x80 | (code & 0x3F));
        else if (code < 0x10000)
            add(0xE0 | code >> 12), add(0x80 | (code >> 6 & 0x3F)), add(0x80 | (code & 0x3F));
        else
            add(0xF0 | code >> 18), add(0x80 | (code >> 12 & 0x3F)), add(0x80 | (code >> 6 & 0x3F)),
                add(0x80 | (code & 0x3F));
    }
    return out;
}

}  // namespace cardan::test
