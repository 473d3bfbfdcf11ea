#include "mbs/base/sizes.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

namespace {

std::string shape(Eigen::Index rows, Eigen::Index cols, bool vector) {
    return vector ? text(rows) : text(rows, " x ", cols);
}

}  // namespace

void refuse_size(const char* where, const char* what, Eigen::Index rows, Eigen::Index cols, Eigen::Index right_rows,
                 Eigen::Index right_cols) {
    const bool vectors = cols == 1 && right_cols == 1;
    throw InputError(where, text("size of ", what), shape(rows, cols, vectors), shape(right_rows, right_cols, vectors));
}

void refuse_index(const char* where, const char* what, std::ptrdiff_t index, std::ptrdiff_t count) {
    throw InputError(where, what, index, count > 0 ? text("0 ... ", count - 1) : "none: there are none");
}

void refuse_model(const char* where, const char* what) {
    throw InputError(text(where, ": the ", what,
                          " belongs to another model; make it from the model that it is used with (copies of a model "
                          "count as the same)"));
}

}  // namespace cardan
