/// @file
/// Owners of the objects of SUNDIALS. For sources only: it includes SUNDIALS.
#pragma once

#include "mbs/base/error.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <memory>
#include <type_traits>

namespace cardan::solvers {

template <auto Free>
struct SundialsDeleter {
    template <class T>
    void operator()(T* p) const {
        Free(p);
    }
};
inline void free_sundials_context(SUNContext c) {
    SUNContext_Free(&c);
}
inline void free_sundials_nonlinear(SUNNonlinearSolver s) {
    SUNNonlinSolFree(s);
}

using SundialsContext = std::unique_ptr<std::remove_pointer_t<SUNContext>, SundialsDeleter<free_sundials_context>>;
using SundialsVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, SundialsDeleter<N_VDestroy>>;
using SundialsMatrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, SundialsDeleter<SUNMatDestroy>>;
using SundialsNonlinear =
    std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, SundialsDeleter<free_sundials_nonlinear>>;

inline SundialsContext make_sundials_context() {
    SUNContext context = nullptr;
    if (SUNContext_Create(nullptr, &context) != 0) throw NumericalError("SUNDIALS: no context");
    return SundialsContext(context);
}

/// Discards messages: failures are reported through return values.
inline void sundials_quiet(int, const char*, const char*, char*, void*) {}

}  // namespace cardan::solvers
