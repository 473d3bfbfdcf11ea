#include "mbs/system/system.hpp"

#include "mbs/base/error.hpp"

namespace cardan {

void System::refuse_loops(const char* where) const {
    throw InputError(where, "loop", loops.describe(0),
                     "none: this analysis knows trees only; time integration, steady states, load paths, harmonic "
                     "balance, Floquet's theory, linear models, natural modes and Campbell diagrams know loops");
}

}  // namespace cardan
